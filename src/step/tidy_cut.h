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

// The mean of the shortest edges of the faces in contact, before they are cut.
f64 spacing_of_contacts(const Workspace& w);

// `spacing`: of the faces that were cut. O(new vertices + faces round them).
void tidy_cut(Attempt& a, f64 spacing);

}  // namespace tpa
