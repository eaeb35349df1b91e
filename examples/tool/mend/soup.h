// SPDX-License-Identifier: MIT
// soup: which triangles of any set meet, closed or not.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "tool/io/mesh_io.h"

namespace tool {

using MeetingPairs = std::vector<std::pair<uint32_t, uint32_t>>;

// Pairs of triangles that meet beyond common corners and edges, by exact arithmetic, in order. Triangles have three
// different corners each; triangles without area count as the segments that they cover. O(n log n + pairs) expected.
MeetingPairs meeting_pairs(const TriangleMesh& mesh);

// Counts as CGAL's self_intersections() does: a triangle without area is one pair, with itself, and no other. Whatever
// lies round such a triangle touches it, so that other counts would tell how neighbours are cut, and not how many
// faults there are.
void count_flat_triangles_once(const TriangleMesh& mesh, MeetingPairs& pairs);

}  // namespace tool
