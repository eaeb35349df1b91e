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

// The components, each at the vertex that stands for it.
std::vector<Part> parts_by_root(const TriangleMesh& mesh, const std::vector<size_t>& root) {
  std::vector<Part> by_root(root.size());
  for (const size_t r : root) ++by_root[r].vertices;
  for (size_t f = 0; f + 2 < mesh.triangles.size(); f += 3) {
    double side[3][3];  // from a vertex of the component, so that a place far from the origin costs no digits
    for (size_t i = 0; i < 3; ++i)
      for (size_t axis = 0; axis < 3; ++axis)
        side[i][axis] = mesh.positions[3 * size_t{mesh.triangles[f + i]} + axis] -
                        mesh.positions[3 * root[mesh.triangles[f]] + axis];
    const auto &a = side[0], &b = side[1], &c = side[2];
    Part& part = by_root[root[mesh.triangles[f]]];
    ++part.triangles;
    part.volume +=
        (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) /
        6;
  }
  return by_root;
}

}  // namespace

std::vector<Part> parts_of(const TriangleMesh& mesh) {
  std::vector<Part> parts;
  for (const Part& p : parts_by_root(mesh, roots_of(mesh)))
    if (p.triangles > 0) parts.push_back(p);
  for (Part& p : parts) {
    // Closed triangle mesh: E = 3 F / 2, so V - E + F = V - F / 2 = 2 - 2 genus.
    p.genus = 1 - (2 * static_cast<long>(p.vertices) - static_cast<long>(p.triangles)) / 4;
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& p, const Part& q) { return p.vertices > q.vertices; });
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
    double side[3][3];  // from the mesh's first vertex, so that a place far from the origin costs no digits
    for (size_t i = 0; i < 3; ++i)
      for (size_t axis = 0; axis < 3; ++axis)
        side[i][axis] = mesh.positions[3 * size_t{mesh.triangles[f + i]} + axis] - mesh.positions[axis];
    const auto &a = side[0], &b = side[1], &c = side[2];
    for (size_t i = 0; i < 3; ++i) {
      const size_t j = (i + 1) % 3, k = (i + 2) % 3;
      sum += a[i] * (b[j] * c[k] - b[k] * c[j]);
      size += std::fabs(a[i]) * (std::fabs(b[j] * c[k]) + std::fabs(b[k] * c[j]));
    }
  }
  volume = sum / 6;
  return sum < -0x1p-52 * (static_cast<double>(mesh.triangles.size()) + 16) * size;
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
