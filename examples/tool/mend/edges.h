// SPDX-License-Identifier: MIT
// edges: sides of triangles, brought together by edge.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tool/io/mesh_io.h"

namespace tool {

// Side i of a triangle runs from its corner i to the next; its number is 3 triangle + i.
inline uint32_t next_side(uint32_t side) { return side % 3 == 2 ? side - 2 : side + 1; }
inline uint32_t tail(const TriangleMesh& mesh, uint32_t side) { return mesh.triangles[side]; }
inline uint32_t head(const TriangleMesh& mesh, uint32_t side) { return mesh.triangles[next_side(side)]; }
// The corner across from a side.
inline uint32_t apex(const TriangleMesh& mesh, uint32_t side) { return mesh.triangles[next_side(next_side(side))]; }
inline bool runs_up(const TriangleMesh& mesh, uint32_t side) { return tail(mesh, side) < head(mesh, side); }

// Calls visit(first, last) with pointers to the sides of each edge in turn, in order of triangles.
template <class Visit>
void for_each_edge(const TriangleMesh& mesh, Visit visit) {
  struct Keyed {
    uint64_t edge;
    uint32_t side;
    bool operator<(const Keyed& o) const { return edge != o.edge ? edge < o.edge : side < o.side; }
  };
  std::vector<Keyed> keyed(mesh.triangles.size());
  for (uint32_t side = 0; side < keyed.size(); ++side) {
    const auto [low, high] = std::minmax({tail(mesh, side), head(mesh, side)});
    keyed[side] = {uint64_t{low} << 32 | high, side};
  }
  std::sort(keyed.begin(), keyed.end());
  std::vector<uint32_t> sides;
  for (size_t i = 0; i < keyed.size();) {
    sides.clear();
    const uint64_t edge = keyed[i].edge;
    for (; i < keyed.size() && keyed[i].edge == edge; ++i) sides.push_back(keyed[i].side);
    visit(sides.data(), sides.data() + sides.size());
  }
}

}  // namespace tool
