// merge_cuts: takes the local refinement of section 5 (figure 6) back once it has served. It halves the edges round a
// contact; where a surface moves on and meets again in the same place, step after step, they would become ever shorter
// beside the ways of the vertices, and what is short folds.
#pragma once

#include "cut/clusters.h"
#include "mesh/journal.h"

namespace tpa {

// After the holes are closed: each new vertex of a cut and the end of its edge that stays become one vertex again, in
// the mean of the new vertices, wherever collapse() finds nothing against it. It keeps the number and the origin of the
// end that stays; Cut::vertex is none then. Where that end has no whole face left, the new vertices are all there is of
// the surface, and stay. Overwrites Clusters::number. The marks have an entry for each vertex and face, zero before and
// after.
void coarsen(Edit& e, NearFaces& g, Clusters& r, u8* vertex_mark, u8* face_mark);

}  // namespace tpa
