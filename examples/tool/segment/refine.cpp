// SPDX-License-Identifier: MIT
#include "tool/segment/refine.h"

#include <algorithm>

#include "tool/segment/forces.h"

namespace tool {

namespace {

using Ends = std::pair<uint32_t, uint32_t>;

Ends ends_of(uint32_t a, uint32_t b) { return a < b ? Ends{a, b} : Ends{b, a}; }

double squared_distance(const TriangleMesh& mesh, uint32_t a, uint32_t b) {
  const Point d = point_at(&mesh.positions[3 * size_t{a}]) - point_at(&mesh.positions[3 * size_t{b}]);
  return dot(d, d);
}

// The triangle c with the middles m of its edges (c[i], c[i + 1]), or none, in up to four triangles.
void divide(const TriangleMesh& mesh, const uint32_t (&c)[3], const uint32_t (&m)[3], uint32_t none,
            std::vector<uint32_t>& triangles) {
  const auto add = [&](uint32_t x, uint32_t y, uint32_t z) { triangles.insert(triangles.end(), {x, y, z}); };
  const size_t cuts = size_t{m[0] != none} + size_t{m[1] != none} + size_t{m[2] != none};
  if (cuts == 0) return add(c[0], c[1], c[2]);
  if (cuts == 3) {
    for (size_t i = 0; i < 3; ++i) add(c[i], m[i], m[(i + 2) % 3]);
    return add(m[0], m[1], m[2]);
  }
  // Turned so that the first edge is cut, and the last is not.
  size_t i = 0;
  while (m[i] == none || m[(i + 2) % 3] != none) ++i;
  const uint32_t p = c[i], q = c[(i + 1) % 3], r = c[(i + 2) % 3], pq = m[i], qr = m[(i + 1) % 3];
  if (qr == none) {
    add(p, pq, r);
    return add(pq, q, r);
  }
  add(pq, q, qr);
  if (squared_distance(mesh, pq, r) < squared_distance(mesh, p, qr)) {
    add(p, pq, r);
    add(pq, qr, r);
  } else {
    add(p, pq, qr);
    add(p, qr, r);
  }
}

}  // namespace

std::vector<Ends> cut_edges(TriangleMesh& mesh, const std::function<bool(uint32_t, uint32_t)>& is_long) {
  std::vector<Ends> cut;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3)
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = mesh.triangles[t + i], b = mesh.triangles[t + (i + 1) % 3];
      if (a < b && is_long(a, b)) cut.emplace_back(a, b);
    }
  if (cut.empty()) return cut;
  std::sort(cut.begin(), cut.end());
  const uint32_t first = static_cast<uint32_t>(mesh.positions.size() / 3), none = UINT32_MAX;
  for (const auto& [a, b] : cut)
    for (size_t k = 0; k < 3; ++k)
      mesh.positions.push_back(0.5 * (mesh.positions[3 * size_t{a} + k] + mesh.positions[3 * size_t{b} + k]));
  std::vector<uint32_t> triangles;
  for (size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const uint32_t c[3] = {mesh.triangles[t], mesh.triangles[t + 1], mesh.triangles[t + 2]};
    uint32_t middles[3];
    for (size_t i = 0; i < 3; ++i) {
      const Ends ends = ends_of(c[i], c[(i + 1) % 3]);
      const auto found = std::lower_bound(cut.begin(), cut.end(), ends);
      const bool is_cut = found != cut.end() && *found == ends;
      middles[i] = is_cut ? first + static_cast<uint32_t>(found - cut.begin()) : none;
    }
    divide(mesh, c, middles, none, triangles);
  }
  mesh.triangles.swap(triangles);
  return cut;
}

}  // namespace tool
