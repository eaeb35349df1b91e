// SPDX-License-Identifier: MIT
// specks: components that a step has made, too small for the sampling: crumbs of the seam, and voids between two
// surfaces that meet all round before they meet in the middle. The region of the moved mesh has them (P3); later moves
// would crumple them, and each further step would make more.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// Means over the faces in contact, before they are cut.
struct CutSizes {
  f64 spacing = 0;   // of the shortest edges
  f64 triangle = 0;  // of the roots of twice the areas: the edges of even triangles, but for a tenth
  f64 longest = 0;   // of the longest edges
};
CutSizes sizes_of_contacts(const Workspace& w);

// Removes small and thin components that the island has made or changed, within its ledger. O(changed faces).
void drop_specks(Attempt& a, const CutSizes& sizes);

}  // namespace tpa
