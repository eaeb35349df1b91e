// SPDX-License-Identifier: MIT
// merge_cuts: takes the local refinement of section 5 (figure 6) back after use. Refinement halves the edges round a
// contact. Where a surface meets again in the same place, step after step, edges would become ever shorter. Edges
// shorter than the ways of their vertices fold.
#pragma once

#include "cut/clusters.h"
#include "mesh/journal.h"

namespace tpa {

// After the holes are closed: merges each new vertex of a cut with the end of its edge outside, wherever collapse()
// finds nothing against it. The merged vertex lies in the mean of the new vertices, and keeps number and origin of the
// end outside; Cut::vertex is none then. If the end outside has no whole face left, the new vertices are all there is
// of the surface, and stay. The marks have an entry for each vertex and face, zero before and after.
// O(faces round the cuts).
void merge_cuts(Edit& e, NearFaces& g, Clusters& r, u8* vertex_mark, u8* face_mark);

}  // namespace tpa
