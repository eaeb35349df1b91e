// sheet: proofs that the faces of some clusters meet nothing.
//
// Look along an axis at the rectangle R that bounds them, and take all faces S over R within a slab of heights. If
// (1) no face of S reaches out of the slab, (2) all of S turn the same side up, and (3) their areas, as seen, add up
// to less than twice that of R, then none of the faces meets any face of S except in what they share.
// For an edge over R belongs to two faces that are over R, and so, by (1), both in S: no border of S runs over R.
// By (2) each point over R that lies on no edge is then covered equally often (the winding number of the border, which
// is constant off it), by (3) once. Two sheets through one point in space would both cover what is near that point.
// Faces outside S have boxes that do not meet theirs.
#pragma once

#include "clusters.h"

namespace tpa {

// For the clusters first .. last - 1, which `node` of the tree bounds.
bool is_single_sheet(const Clusters& c, u32 node, u32 first, u32 last);

}  // namespace tpa
