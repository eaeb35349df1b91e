// snap_cuts: where the cut may run along the vertices outside the clusters (section 5, figure 6). Local refinement
// makes the loops simple polygons; most are without it, and then nothing has to be made only to be taken back.
#pragma once

#include "cut/clusters.h"

namespace tpa {

// Before cut(): draws cuts back to the ends that stay, where these make as simple polygons as new vertices do: none
// comes twice, and of two that are neighbours in what stays, and on loops, one follows the other. Overwrites
// Clusters::number. The marks have an entry for each vertex, zero before and after. O(cuts).
void draw_back(const Mesh& m, Clusters& r, u8* vertex_mark);

// After cut(), and when the loops are closed: the cuts that were drawn back, each vertex once, in the place of all
// cuts. They and their middles outlast clear(). Orders the loops otherwise.
Span<const Cut> collect_drawn(Clusters& r);

}  // namespace tpa
