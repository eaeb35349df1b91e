// SPDX-License-Identifier: MIT
// specks: components that a step has made, too small for the sampling: crumbs of the seam, and voids between two
// surfaces that meet all round before they meet in the middle. The region of the moved mesh has them (P3); later moves
// would crumple them, and each further step would make more.
#pragma once

#include "step/attempt.h"

namespace tpa {

// The shares of the volume of all bodies that a body and a void may have: a void as much as the caps of a tunnel
// (step/close_tunnels.h), another way to fill a gap.
inline constexpr f64 speck_share = 0.001, thin_void_share = 0.01;
// The vertices that either may have, so that a search for large components stays local.
inline constexpr u32 most_of_speck = 512;

// Means over the faces in contact, before they are cut.
struct CutSizes {
  f64 spacing = 0;   // of the shortest edges
  f64 triangle = 0;  // of the roots of twice the areas: the edges of even triangles, but for a tenth
  f64 longest = 0;   // of the longest edges
};
CutSizes sizes_of_contacts(const Workspace& w);

// Removes small and thin components that the step has made. O(changed faces), and O(V) where a small one is found.
void drop_specks(Attempt& a, const CutSizes& sizes);

}  // namespace tpa
