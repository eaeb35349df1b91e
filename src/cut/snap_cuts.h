// snap_cuts: draws the cut back to the vertices outside the clusters (section 5, figure 6). Local refinement serves to
// make the loops simple polygons; most loops are simple without refinement, and no new vertices are needed that
// merge_cuts would only take back.
#pragma once

#include "cut/clusters.h"

namespace tpa {

// Before cut(): draws cuts back to the ends outside, where these ends make polygons as simple as new vertices would. No
// vertex comes twice; if two vertices on loops are neighbours in the rest of the mesh, one follows the other. The marks
// have an entry for each vertex, zero before and after. O(cuts).
void draw_back(const Mesh& m, Clusters& r, u8* vertex_mark);

// After cut(), with the loops closed: overwrites the cuts with those drawn back, one for each vertex. They and their
// middles outlast clear(). Changes the order of the loops. O(cuts + loops log loops).
Span<const Cut> collect_drawn(Clusters& r);

}  // namespace tpa
