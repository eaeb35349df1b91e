// SPDX-License-Identifier: MIT
// face_tree_edit: the face tree while the mesh is edited. A changed face keeps its place, with a new box. A face far
// from its leaf moves to the best leaf for its box, if a gap is left there; new faces take gaps as well. Boxes of the
// nodes above grow and never shrink, and stay tight while faces stay near.
#pragma once

#include "detect/face_tree.h"

namespace tpa {

// Spreads the leaves over `capacity` places, a place for each face that the mesh may have. Each leaf gets an even share
// of the gaps behind its faces. Notes the place of each face. Pre: arranged, and not loose. O(V).
void loosen(FaceTree& tree, u32 capacity);
inline bool is_loose(const FaceTree& tree) { return tree.numbered != 0; }

// All of the following need is_loose(tree).
bool is_in_tree(const FaceTree& tree, u32 f);
// Puts a face in, or moves it there, with its corners and a box in tree units. Leaves of a hub are left to faces at the
// hub, but for a few leaves. Expected O(log V); O(V) to find a gap in a crowded tree.
struct PutInTree {
  u32 leaf;
  u32 looked;  // leaves in which a gap was sought
};
PutInTree put_in_tree(FaceTree& tree, u32 f, const u32* corner, const Box& box);
// Pre: is_in_tree(tree, f). O(1).
void take_from_tree(FaceTree& tree, u32 f);
// Gives a face in the tree the number of a face not in the tree, and the other way round. Pre: is_in_tree(tree, f), not
// is_in_tree(tree, to). O(1).
void rename_in_tree(FaceTree& tree, u32 f, u32 to);

}  // namespace tpa
