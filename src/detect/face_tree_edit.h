// face_tree_edit: the tree of clusters while the mesh is edited. A face that changes keeps its place, with its new box;
// one that has come far moves to the cluster that suits it best, if there is a gap at its end. New faces take such
// gaps. The boxes above grow and do not shrink, which is as good while faces stay near the place where they were
// arranged.
#pragma once

#include "detect/face_tree.h"

namespace tpa {

// Spreads the clusters, if there are any, so that all places are shared among them, as many as the mesh may have faces,
// `capacity`; and notes where each face is. O(V).
void loosen(FaceTree& c, u32 capacity);
inline bool is_loose(const FaceTree& c) { return c.numbered != 0; }

// Is the face in the tree? Pre: is_loose(c).
bool is_in_tree(const FaceTree& c, u32 f);
// Puts a face in, or moves it there, with a box in the units of the clusters. Pre: is_loose(c).
void put_in_tree(FaceTree& c, u32 f, const Box& box);
// Pre: is_in_tree(c, f).
void take_from_tree(FaceTree& c, u32 f);
// A face gets the number of one that is not in the tree, and that one its own. Pre: is_in_tree(c, f).
void rename_in_tree(FaceTree& c, u32 f, u32 to);

}  // namespace tpa
