// keep_exposed: of the faces that cross, what is seen may stay. Section 5 removes all vertices of faces in contact; one
// that lies on the boundary of the region, with nothing but swallowed vertices beyond the faces that come through, need
// not go: its faces are cut short of them. What goes is then as narrow as it can be, the loops on the two sides of a
// seam run close to each other, and where seams come near each other they stay apart.
#pragma once

#include "cut/intersection_curves.h"

namespace tpa {

// After find_pieces(): takes out of the clusters what may stay, but no vertex that comes from an old one marked
// as taken_along. The others make clusters anew; their loops are to be found again. Returns how many stay. Faces in
// contact keep a vertex in a cluster; those that only touch, or meet their own cluster, keep all of them there.
// O(members + contacts log contacts).
u32 keep_visible(const Mesh& m, Span<const Contact> contacts, const u8* marks, Clusters& r, const SeamScratch& s);

}  // namespace tpa
