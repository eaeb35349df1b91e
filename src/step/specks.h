// SPDX-License-Identifier: MIT
// specks: components that a step has made, too small for the sampling: crumbs of the seam, and voids between two
// surfaces that meet all round before they meet in the middle. The region of the moved mesh has them (P3); later moves
// would crumple them, and each further step would make more.
#pragma once

#include "step/attempt.h"

namespace tpa {

// The shares of the volume of all bodies: of all specks of a step together, as of the caps of its tunnels
// (step/close_tunnels.h), another way to fill gaps; and of a body.
inline constexpr f64 specks_share = 0.01, body_share = 0.001;
// The vertices of a speck, so that the search of large components stays local.
inline constexpr u32 most_of_speck = 512;

// Means over the faces in contact, before they are cut.
struct CutSizes {
  f64 spacing = 0;   // of the shortest edges
  f64 triangle = 0;  // of the roots of twice the areas: the edges of even triangles, but for a tenth
  f64 longest = 0;   // of the longest edges
};
CutSizes sizes_of_contacts(const Workspace& w);

// Removes small and thin components that the step has made or changed. O(changed faces), and O(V) where one is found.
void drop_specks(Attempt& a, const CutSizes& sizes);

}  // namespace tpa
