// SPDX-License-Identifier: MIT
// snap_cuts: the cut runs along vertices outside the clusters (section 5, figure 6). Local refinement serves to
// make the loops simple polygons; most loops are simple without refinement, and no new vertices are needed that
// merge_cuts would only take back.
#pragma once

#include "cut/clusters.h"

namespace tpa {

// Before cut(): snaps cuts to their ends outside, if these make polygons as simple as new vertices would. No
// vertex comes twice; if two vertices on loops are neighbours in the rest of the mesh, one follows the other. The marks
// have an entry for each vertex, zero before and after. O(cuts).
void snap_cuts(const Mesh& m, Clusters& r, u8* vertex_mark);

// After cut(), with the loops closed: overwrites the cuts with the snapped cuts, one for each vertex. They and their
// middles outlast forget_clusters(). Changes the order of the loops. O(cuts + loops log loops).
Span<const Cut> collect_snapped(Clusters& r);

}  // namespace tpa
