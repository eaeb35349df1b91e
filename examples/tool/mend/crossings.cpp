// SPDX-License-Identifier: MIT
#include "tool/mend/crossings.h"

#include <algorithm>
#include <set>

#include "tool/mend/triangle_tree.h"

namespace tool {

Crossings count_crossings(const TriangleMesh& mesh) {
  const TriangleTree tree(mesh.positions, mesh.triangles);
  const auto corners = [&](uint32_t t) {
    const uint32_t* c = &mesh.triangles[3 * size_t{t}];
    return Corners{c[0], c[1], c[2]};
  };
  Crossings found;
  std::set<std::pair<int32_t, int32_t>> labels;
  for (uint32_t t = 0; t < mesh.labels.size(); ++t)
    tree.for_each(tree.box(t), [&](uint32_t other) {
      const int32_t a = mesh.labels[t], b = mesh.labels[other];
      if (other <= t || a == b || !triangles_meet(mesh.positions.data(), corners(t), corners(other))) return true;
      ++found.triangles;
      labels.insert(std::minmax(a, b));
      return true;
    });
  found.labels = labels.size();
  return found;
}

}  // namespace tool
