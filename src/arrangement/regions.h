// SPDX-License-Identifier: MIT
// regions: the winding numbers in front of all pieces. They follow from piece to piece round the edges; one exact ray
// tells the first of each connected group.
#pragma once

#include "arrangement/arrangement.h"
#include "detect/near_faces.h"

namespace tpa {

// False for a contradiction, if the meter stops, or where every piece of a group is too small for a ray. Pre:
// link_edges(). O(pieces), and for each group O(faces along a ray).
bool find_windings(Arrangement& a, const NearFaces& g, i32 winding_at_infinity);

}  // namespace tpa
