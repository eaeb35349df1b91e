// refit: the tree of clusters while the mesh is edited. A face that changes keeps its place, with its new box; new
// faces take gaps at the ends of clusters. The boxes above grow and do not shrink, which is as good while faces stay
// near the place where they were arranged.
#pragma once

#include "clusters.h"

namespace tpa {

// Spreads the clusters, for gaps after each as far as there is memory, and notes where each face is. `c` has as many
// places as the mesh may have faces, `capacity`. O(V).
void loosen(Clusters& c, u32 capacity);
inline bool is_loose(const Clusters& c) { return c.numbered != 0; }

// Is the face in the tree? Pre: is_loose(c).
bool is_in_tree(const Clusters& c, u32 f);
// Puts a face in, or moves it there, with a box in the units of the clusters. False where there is no place for it among
// those near it; then it is not in. Pre: is_loose(c).
bool put_in_tree(Clusters& c, u32 f, const FlatBox& box);
// Takes it out; false where it is not in. Pre: is_loose(c).
bool take_from_tree(Clusters& c, u32 f);

}  // namespace tpa
