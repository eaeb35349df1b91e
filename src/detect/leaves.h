// leaves: the surface in connected pieces of some forty faces, found by breadth-first search over adjacency. They
// follow the surface whatever the numbering, the sizes of the faces, and what else is near in space.
//
// Where so many are small that they would be more than a third of the faces, the last ones are of several pieces, found
// by number.
//
// Large meshes are cut into zones first, and patches grow within them, each zone on its own. Zones are ranges of
// numbers, or parts of space where numbers tell nothing; neither depends on the number of threads.
#pragma once

#include "base/arena.h"
#include "base/parallel.h"
#include "mesh/half_edges.h"

namespace tpa {

inline constexpr u32 fewest_in_patch = 16, most_in_patch = 40;
// Where most of the surface bends by so much from face to face that beside a larger one something would lean too far.
inline constexpr u32 most_in_bent_patch = 20;
// Patches with fewer faces than fewest_in_patch join a neighbour that has room. FaceTree of eight took 18 bytes more
// for each vertex, and no less time.
inline constexpr u32 most_in_joined_patches = 56;
inline constexpr u32 most_zones = 16;

// Of many tetrahedra each still has one, and some two, where zones cut them.
constexpr u32 most_patches_in_zone(u32 faces) { return faces / 4 + faces / 16 + 1; }
// In all zones, with a number more for each that no patch has.
constexpr u64 most_patches(u64 faces) { return faces / 4 + faces / 16 + 3 * most_zones; }

struct Patches {
  u32 zones = 0;
  u32 start[most_zones] = {};  // by zone: its first patch
  u32 count[most_zones] = {};  // by zone: its patches
  u32* face = nullptr;         // patch after patch, in the order of the search
  u32* first = nullptr;        // by patch, and one more for each zone: its first place in `face`
  u32* leader = nullptr;       // by patch: the patch that it has joined, or itself
  u32* following = nullptr;    // by patch: the next one of those joined, or none
  u8* size = nullptr;          // of leaders: the faces of all that have joined
  u8* looked = nullptr;        // how many of its faces the search went on from before the patch was full
};
// Arrays for so many faces.
void lay_out_patches(Carver& carver, u64 faces, Patches& p);

template <class Visit>
inline void for_each_patch(const Patches& p, Visit visit) {
  for (u32 z = 0; z < p.zones; ++z)
    for (u32 i = 0; i < p.count[z]; ++i) visit(p.start[z] + i);
}

// Of all living faces; `patch_of` takes the patch of each. `point`: x, y, z of each vertex, within -1 .. 1; a
// number more is read. O(F).
void find_patches(const Mesh& m, const f32* point, const Exec& exec, Patches& p, u32* patch_of);

}  // namespace tpa
