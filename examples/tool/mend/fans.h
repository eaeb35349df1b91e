// SPDX-License-Identifier: MIT
// fans: which triangles hang together at edges and vertices. Edges of four and more triangles, and vertices where fans
// touch, are parted; the surface stays in its place.
#pragma once

#include <cstdint>
#include <vector>

#include "tool/io/mesh_io.h"

namespace tool {

struct Parted {
  size_t edges = 0;               // that more than two triangles had
  std::vector<uint32_t> copied;   // the vertex that each new vertex is a copy of, or lies beside
  std::vector<uint32_t> divided;  // the triangle that each new triangle is a part of
  size_t against = 0;             // edges of two triangles that run the same way
  std::vector<uint32_t> open;     // sides without a partner: the rim of the surface, if there is one
};

// At an edge, triangles pair off that have the inside between them, so that bodies with a common edge become two. A
// vertex becomes as many as there are fans round it. Where two pairs at an edge have both ends in common even then, as
// in a body that touches itself along the edge, each pair gets a vertex of its own in the middle. Corners of each
// triangle differ. O(n log n).
Parted part_fans(TriangleMesh& mesh);

}  // namespace tool
