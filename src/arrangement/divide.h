// SPDX-License-Identifier: MIT
// divide: the triangles into which facets are divided along all traces in their planes.
#pragma once

#include "arrangement/arrangement.h"

namespace tpa {

// Divides all facets into pieces. Triangles that as many faces cover from the front as from behind bound nothing, and
// are left out. False if room runs out, or clearly would (Arrangement::wanted), or the meter stops. O(n log n) in the
// points of a facet, but for crowded seams.
bool divide_facets(Arrangement& a);

}  // namespace tpa
