// patches: the surface in connected pieces of some forty faces, found by breadth-first search over adjacency. They
// follow the surface whatever the numbering, the sizes of the faces, and what else is near in space; positions do not
// matter.
#pragma once

#include "arena.h"
#include "mesh.h"

namespace tpa {

inline constexpr u32 fewest_in_patch = 8, most_in_patch = 40;
// Patches with fewer faces than fewest_in_patch join a neighbour that has room.
inline constexpr u32 most_in_joined_patches = 56;

struct Patches {
  u32 count = 0;
  u32* face = nullptr;   // patch after patch, in the order of the search
  u32* first = nullptr;  // by patch, and one more: its first place in `face`
  u32* leader = nullptr;     // by patch: the patch that it has joined, or itself
  u32* following = nullptr;  // by patch: the next one of those joined, or none
  u8* size = nullptr;        // of leaders: the faces of all that have joined
  u8* looked = nullptr;      // how many of its faces the search went on from before the patch was full
};
// Arrays for so many faces: a patch has one at least.
void lay_out_patches(Carver& carver, u64 faces, Patches& p);

// Of all living faces; `patch_of` takes the patch of each. O(F).
void find_patches(const Mesh& m, Patches& p, u32* patch_of);

}  // namespace tpa
