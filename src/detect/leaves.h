// SPDX-License-Identifier: MIT
// leaves: cuts the surface into buds for the leaves of the face tree (detect/face_tree.h). A bud is some forty
// connected faces, gathered by breadth-first search over adjacency. A leaf is one bud, or a few small buds together.
// Buds follow the surface: numbering, sizes of faces and other surface nearby do not matter. (The paper hashes vertices
// instead, section 3.)
//
// Tiny components might need a bud for every other face. The arrays have room for fewer buds than a third of the faces.
// To stay within, the last buds take several pieces each, in the order of their numbers.
//
// Large meshes are cut into zones first, and each zone grows its own buds. Zones are ranges of face numbers, or parts
// of space if numbers say nothing of nearness. The number of threads does not matter.
#pragma once

#include "base/arena.h"
#include "base/parallel.h"
#include "mesh/half_edges.h"

namespace tpa {

// Faces of a bud. Smaller buds join an adjacent bud with room; both sizes are measured (docs/notes/detection.md).
inline constexpr u32 fewest_in_bud = 16, most_in_bud = 40;
// Faces of a bud on a surface mostly bent: larger leaves would hold faces leaning too far for a proof.
inline constexpr u32 most_in_bent_bud = 20;
inline constexpr u32 most_in_joined_buds = 56;
inline constexpr u32 most_zones = 16;

// Bound on the buds of a zone. A quarter is a bud for each of many tetrahedra; the rest is for tetrahedra cut into two
// buds by a border of zones.
constexpr u32 most_buds_in_zone(u32 faces) { return faces / 4 + faces / 16 + 1; }
// Bound for all zones, each with a number more, of no bud.
constexpr u64 most_buds(u64 faces) { return faces / 4 + faces / 16 + 3 * most_zones; }

struct Buds {
  u32 zones = 0;
  u32 start[most_zones] = {};  // by zone: its first bud
  u32 count[most_zones] = {};  // by zone: its buds
  u32* face = nullptr;         // bud after bud, in the order of the search
  u32* first = nullptr;        // by bud, and an end for each zone: its first place in `face`
  u32* leader = nullptr;       // by bud: the bud joined by it, or itself
  u32* following = nullptr;    // by bud: the next bud with the same leader, or none
  u8* size = nullptr;          // by leader: faces of all buds joined
  u8* looked = nullptr;        // by bud: faces at its start without free faces beside them
};
// Lays out the arrays for a number of faces.
void lay_out_buds(Carver& carver, u64 faces, Buds& b);

template <class Visit>
inline void for_each_bud(const Buds& b, Visit visit) {
  for (u32 z = 0; z < b.zones; ++z)
    for (u32 i = 0; i < b.count[z]; ++i) visit(b.start[z] + i);
}

// Grows buds over all living faces; `bud_of` takes the bud of each face. `point`: x, y, z of each vertex, within
// -1 .. 1, and a number more, since four are read at once. O(F).
void grow_buds(const Mesh& m, const f32* point, const Exec& exec, Buds& b, u32* bud_of);

}  // namespace tpa
