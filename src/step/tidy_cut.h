// SPDX-License-Identifier: MIT
// tidy_cut: the surface after the exact cut of a step. Seams bring many vertices, closer to each other than those of
// the mesh; the next moves would fold their edges. New vertices merge until they are about as far apart as old ones.
// Nothing is smoothed: between triangles of very different sizes, smoothing would carry the seam away from the bodies.
// Each operation is tested, so the mesh stays free of contacts.
#pragma once

#include "step/attempt.h"

namespace tpa {

// New vertices are apart by this share of the spacing at least.
inline constexpr f64 closest_share = 0.5;

// The shares of the volume of all bodies by which merging may change the region, and that of a component that may go.
inline constexpr f64 merging_share = 0.01, speck_share = 0.001;

// Means over the faces in contact, before they are cut.
struct CutSizes {
  f64 spacing = 0;   // of the shortest edges
  f64 triangle = 0;  // of the roots of twice the areas: the edges of even triangles, but for a tenth
  f64 longest = 0;   // of the longest edges
};
CutSizes sizes_of_contacts(const Workspace& w);

// Removes small and thin components that the cut has made. O(V).
void drop_specks(Attempt& a, const CutSizes& sizes);

// Specks first, then the rest. O(V + faces round new vertices).
void tidy_cut(Attempt& a, const CutSizes& sizes);

}  // namespace tpa
