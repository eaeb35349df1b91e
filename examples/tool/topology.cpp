// SPDX-License-Identifier: MIT
#include "tool/topology.h"

#include <algorithm>
#include <numeric>

namespace tool {

std::vector<Part> parts_of(const TriangleMesh& mesh) {
  const size_t n = mesh.positions.size() / 3;
  std::vector<size_t> root(n);
  std::iota(root.begin(), root.end(), size_t{0});
  const auto find = [&](size_t v) {
    while (root[v] != v) v = root[v] = root[root[v]];
    return v;
  };
  for (size_t f = 0; f + 2 < mesh.triangles.size(); f += 3)
    for (size_t i = 1; i < 3; ++i) root[find(mesh.triangles[f])] = find(mesh.triangles[f + i]);
  std::vector<Part> by_root(n);
  for (size_t v = 0; v < n; ++v) ++by_root[find(v)].vertices;
  for (size_t f = 0; f + 2 < mesh.triangles.size(); f += 3) {
    const double *a = &mesh.positions[3 * size_t{mesh.triangles[f]}],
                 *b = &mesh.positions[3 * size_t{mesh.triangles[f + 1]}],
                 *c = &mesh.positions[3 * size_t{mesh.triangles[f + 2]}];
    Part& part = by_root[find(mesh.triangles[f])];
    ++part.triangles;
    part.volume +=
        (a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) + a[2] * (b[0] * c[1] - b[1] * c[0])) /
        6;
  }
  std::vector<Part> parts;
  for (size_t v = 0; v < n; ++v)
    if (find(v) == v && by_root[v].triangles > 0) parts.push_back(by_root[v]);
  for (Part& p : parts) {
    // Closed triangle mesh: E = 3 F / 2, so V - E + F = V - F / 2 = 2 - 2 genus.
    p.genus = 1 - (2 * static_cast<long>(p.vertices) - static_cast<long>(p.triangles)) / 4;
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& p, const Part& q) { return p.vertices > q.vertices; });
  return parts;
}

}  // namespace tool
