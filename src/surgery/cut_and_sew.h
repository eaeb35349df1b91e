// SPDX-License-Identifier: MIT
// cut_and_sew: edits the mesh as decided: local refinement and removal of the clusters (section 5, figure 6), then new
// faces across the holes. NearFaces follow every edit.
#pragma once

#include "cut/clusters.h"
#include "handles/words.h"
#include "mesh/journal.h"

namespace tpa {

// Cuts every edge of the loops, at the end outside if snapped, else in the middle of the visible part. New vertices are
// joined across their faces; all vertices of the clusters are removed with their faces. The loops are holes then: the
// vertices of their cuts run round the hole, each once, and cuts[i].border is the half-edge of the rest from the vertex
// of cuts[i + 1] to the vertex of cuts[i]. False if vertices or faces run out. O(members + cuts).
bool cut(Edit& e, NearFaces& g, Clusters& r);

// Adds faces to mesh and NearFaces, still without neighbours; `placed` collects their numbers. Corners are places in
// `vertices`. False if faces run out; nothing is placed then. O(faces).
bool place(Edit& e, NearFaces& g, Span<const u32> vertices, Span<const FaceCorners> faces, Stack<u32>& placed);
// Takes placed[from ..] out of mesh, NearFaces and list.
void unplace(Edit& e, NearFaces& g, Stack<u32>& placed, u32 from);

// Sews placed faces to each other and to the borders of the holes, the half-edges of the rest along the loops. `table`
// has 6 * placed.size entries, overwritten. O(faces) expected.
void sew(Edit& e, Span<const u32> placed, Span<const u32> borders, u32* table);

}  // namespace tpa
