// SPDX-License-Identifier: MIT
#include "tool/topology.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace tool {

namespace {

// For each vertex, a vertex that stands for its component.
std::vector<size_t> roots_of(const TriangleMesh& mesh) {
  std::vector<size_t> root(mesh.positions.size() / 3);
  std::iota(root.begin(), root.end(), size_t{0});
  const auto find = [&](size_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (size_t f = 0; f + 2 < mesh.triangles.size(); f += 3)
    for (size_t i = 1; i < 3; ++i) root[find(mesh.triangles[f])] = find(mesh.triangles[f + i]);
  for (size_t v = 0; v < root.size(); ++v) root[v] = find(v);
  return root;
}

// Six times the signed volume of a triangle with the origin `from`, and the sum of its terms' magnitudes.
struct Wedge {
  double volume = 0, size = 0;
};

// From a vertex nearby, so that a place far from the origin costs no digits.
Wedge wedge_of(const TriangleMesh& mesh, size_t f, const double* from) {
  double side[3][3];
  for (size_t i = 0; i < 3; ++i)
    for (size_t axis = 0; axis < 3; ++axis)
      side[i][axis] = mesh.positions[3 * size_t{mesh.triangles[f + i]} + axis] - from[axis];
  const auto &a = side[0], &b = side[1], &c = side[2];
  Wedge wedge;
  for (size_t i = 0; i < 3; ++i) {
    const size_t j = (i + 1) % 3, k = (i + 2) % 3;
    wedge.volume += a[i] * (b[j] * c[k] - b[k] * c[j]);
    wedge.size += std::fabs(a[i]) * (std::fabs(b[j] * c[k]) + std::fabs(b[k] * c[j]));
  }
  return wedge;
}

// A bound on the rounding of the sum of so many wedges, of the sum of their sizes.
double doubt_of(size_t triangles, double size) { return 0x1p-52 * (static_cast<double>(triangles) + 16) * size; }

// The components, each at the vertex that stands for it.
std::vector<Part> parts_by_root(const TriangleMesh& mesh, const std::vector<size_t>& root) {
  std::vector<Part> by_root(root.size());
  for (size_t v = 0; v < root.size(); ++v) {
    Part& part = by_root[root[v]];
    for (size_t axis = 0; axis < 3; ++axis) {
      const double x = mesh.positions[3 * v + axis];
      part.low[axis] = part.vertices == 0 ? x : std::min(part.low[axis], x);
      part.high[axis] = part.vertices == 0 ? x : std::max(part.high[axis], x);
    }
    ++part.vertices;
  }
  for (size_t f = 0; f + 2 < mesh.triangles.size(); f += 3) {
    const size_t r = root[mesh.triangles[f]];
    const Wedge wedge = wedge_of(mesh, f, &mesh.positions[3 * r]);
    ++by_root[r].triangles;
    by_root[r].volume += wedge.volume;
    by_root[r].volume_doubt += wedge.size;
  }
  for (Part& part : by_root) {
    part.volume /= 6;
    part.volume_doubt = doubt_of(part.triangles, part.volume_doubt / 6);
  }
  return by_root;
}

}  // namespace

std::vector<Part> parts_of(const TriangleMesh& mesh) {
  std::vector<uint32_t> ignored;
  return parts_of(mesh, ignored);
}

std::vector<Part> parts_of(const TriangleMesh& mesh, std::vector<uint32_t>& part_of_triangle) {
  const std::vector<size_t> root = roots_of(mesh);
  const std::vector<Part> by_root = parts_by_root(mesh, root);
  std::vector<size_t> order;
  for (size_t r = 0; r < by_root.size(); ++r)
    if (by_root[r].triangles > 0) order.push_back(r);
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t p, size_t q) { return by_root[p].vertices > by_root[q].vertices; });
  std::vector<Part> parts;
  std::vector<uint32_t> number(root.size());
  for (const size_t r : order) {
    number[r] = static_cast<uint32_t>(parts.size());
    parts.push_back(by_root[r]);
    // Closed triangle mesh: E = 3 F / 2, so V - E + F = V - F / 2 = 2 - 2 genus.
    Part& p = parts.back();
    p.genus = 1 - (2 * static_cast<long>(p.vertices) - static_cast<long>(p.triangles)) / 4;
  }
  part_of_triangle.clear();
  for (size_t f = 0; f + 2 < mesh.triangles.size(); f += 3) part_of_triangle.push_back(number[root[mesh.triangles[f]]]);
  return parts;
}

size_t drop_small_parts(TriangleMesh& mesh, double least) {
  const std::vector<size_t> root = roots_of(mesh);
  const std::vector<Part> by_root = parts_by_root(mesh, root);
  const auto stays = [&](size_t v) { return std::fabs(by_root[root[v]].volume) >= least; };
  size_t dropped = 0;
  for (size_t v = 0; v < root.size(); ++v) dropped += root[v] == v && !stays(v) ? 1u : 0u;
  if (dropped == 0) return 0;
  TriangleMesh kept;
  std::vector<uint32_t> id(root.size());
  for (size_t v = 0; v < root.size(); ++v) {
    if (!stays(v)) continue;
    id[v] = static_cast<uint32_t>(kept.positions.size() / 3);
    kept.positions.insert(kept.positions.end(), &mesh.positions[3 * v], &mesh.positions[3 * v] + 3);
  }
  for (size_t f = 0; f + 2 < mesh.triangles.size(); f += 3)
    if (stays(mesh.triangles[f]))
      for (size_t i = 0; i < 3; ++i) kept.triangles.push_back(id[mesh.triangles[f + i]]);
  mesh = std::move(kept);
  return dropped;
}

bool is_inside_out(const TriangleMesh& mesh, double& volume) {
  double sum = 0, size = 0;
  for (size_t f = 0; f + 2 < mesh.triangles.size(); f += 3) {
    const Wedge wedge = wedge_of(mesh, f, mesh.positions.data());
    sum += wedge.volume;
    size += wedge.size;
  }
  volume = sum / 6;
  return sum < -doubt_of(mesh.triangles.size(), size);
}

void turn_round(TriangleMesh& mesh) {
  for (size_t f = 0; f + 2 < mesh.triangles.size(); f += 3) std::swap(mesh.triangles[f + 1], mesh.triangles[f + 2]);
}

size_t clear_tiny_coordinates(TriangleMesh& mesh) {
  size_t count = 0;
  for (double& x : mesh.positions) {
    if (x == 0 || !(std::fabs(x) < 0x1p-100)) continue;
    x = 0;
    ++count;
  }
  return count;
}

}  // namespace tool
