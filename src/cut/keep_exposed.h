// SPDX-License-Identifier: MIT
// keep_exposed: visible vertices of faces that cross may stay. Section 5 removes all vertices of faces in contact. A
// vertex on the boundary of the region need not go if only swallowed vertices lie beyond the piercing faces: cuts run
// short of the piercing faces. Clusters are then as narrow as possible, the loops on the two sides of a seam run close
// to each other, and seams near each other stay apart.
#pragma once

#include "cut/intersection_curves.h"

namespace tpa {

// After find_pieces(): takes vertices that may stay out of the clusters, but no vertex from an old vertex marked
// taken_along. The other members make clusters anew; their loops are to be found again. Returns the number of vertices
// that stay. Each face in contact keeps a vertex in a cluster; faces that only touch, or meet their own cluster, keep
// all vertices there. O(members + contacts log contacts).
u32 keep_exposed(const Mesh& m, Span<const Contact> contacts, const u8* marks, Clusters& r, const SeamScratch& s);

}  // namespace tpa
