// SPDX-License-Identifier: MIT
#include "tool/mend/soup.h"

#include <algorithm>

#include "tool/mend/triangle_tree.h"

namespace tool {

namespace {

Corners corners_of(const TriangleMesh& mesh, uint32_t f) {
  const uint32_t* v = &mesh.triangles[3 * size_t{f}];
  return {v[0], v[1], v[2]};
}

}  // namespace

MeetingPairs meeting_pairs(const TriangleMesh& mesh) {
  const TriangleTree tree(mesh.positions, mesh.triangles);
  MeetingPairs pairs;
  const auto count = static_cast<uint32_t>(mesh.triangles.size() / 3);
  for (uint32_t f = 0; f < count; ++f)
    tree.for_each(tree.box(f), [&](uint32_t g) {
      if (f < g && triangles_meet(mesh.positions.data(), corners_of(mesh, f), corners_of(mesh, g)))
        pairs.emplace_back(f, g);
      return true;
    });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

void count_flat_triangles_once(const TriangleMesh& mesh, MeetingPairs& pairs) {
  const auto count = static_cast<uint32_t>(mesh.triangles.size() / 3);
  std::vector<uint8_t> is_flat(count);
  for (uint32_t f = 0; f < count; ++f) is_flat[f] = has_no_area(mesh.positions.data(), corners_of(mesh, f)) ? 1 : 0;
  std::erase_if(pairs, [&](const auto& pair) { return is_flat[pair.first] != 0 || is_flat[pair.second] != 0; });
  for (uint32_t f = 0; f < count; ++f)
    if (is_flat[f] != 0) pairs.emplace_back(f, f);
  std::sort(pairs.begin(), pairs.end());
}

}  // namespace tool
