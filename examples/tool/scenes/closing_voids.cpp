// SPDX-License-Identifier: MIT
#include "tool/scenes/closing_voids.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace tool {

namespace {

// The component of each vertex, named by its smallest vertex.
std::vector<uint32_t> components_of(const Moment& m) {
  std::vector<uint32_t> parent(m.vertices());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto find = [&](uint32_t v) {
    while (parent[v] != v) v = parent[v] = parent[parent[v]];
    return v;
  };
  for (size_t i = 0; i < m.triangles.size(); i += 3)
    for (size_t k = 1; k < 3; ++k) {
      const uint32_t a = find(m.triangles[i]), b = find(m.triangles[i + k]);
      parent[std::max(a, b)] = std::min(a, b);
    }
  for (uint32_t v = 0; v < parent.size(); ++v) parent[v] = find(v);
  return parent;
}

struct Component {
  double volume = 0;
  Point sum{};
  double vertices = 0;
  bool closes = true;
  Point middle() const { return 1 / vertices * sum; }
};

}  // namespace

void turn_closing_voids(const Moment& m, const std::vector<bool>& overdue, std::vector<double>& targets) {
  const std::vector<uint32_t> name = components_of(m);
  std::vector<Component> components(m.vertices());
  for (size_t v = 0; v < m.vertices(); ++v) {
    Component& c = components[name[v]];
    c.sum = c.sum + m.position(v);
    c.vertices += 1;
  }
  for (size_t i = 0; i < m.triangles.size(); i += 3) {
    Component& c = components[name[m.triangles[i]]];
    const Point middle = c.middle(), p = m.position(m.triangles[i]) - middle,
                q = m.position(m.triangles[i + 1]) - middle, r = m.position(m.triangles[i + 2]) - middle;
    c.volume += dot(p, cross(q, r)) / 6;
  }
  const auto reaches = [&](size_t v, const Point& middle) {
    const Point target{targets[3 * v], targets[3 * v + 1], targets[3 * v + 2]}, p = m.position(v);
    return length(target - p) >= length(middle - p);
  };
  for (size_t v = 0; v < m.vertices(); ++v) {
    Component& c = components[name[v]];
    if ((overdue.empty() || !overdue[v]) && !reaches(v, c.middle())) c.closes = false;
  }
  for (size_t v = 0; v < m.vertices(); ++v) {
    const Component& c = components[name[v]];
    if (!c.closes || !(c.volume < 0)) continue;
    const Point beyond = c.middle() + 1.0 / 3 * (c.middle() - m.position(v));
    for (size_t i = 0; i < 3; ++i) targets[3 * v + i] = beyond[i];
  }
}

}  // namespace tool
