// SPDX-License-Identifier: MIT
// tidy_cut: the surface after the exact cut of a step. Seams bring many vertices, closer to each other than those of
// the mesh; the next moves would fold their edges. New vertices merge until they are as far apart as old ones, then the
// surface round them is smoothed (section 5). Each operation is tested, so the mesh stays free of contacts.
#pragma once

#include "step/attempt.h"

namespace tpa {

// The shares of the volume of all bodies by which merging and smoothing may change the region, and that of a component
// that may go.
inline constexpr f64 merging_share = 0.01, smoothing_share = 0.03, speck_share = 0.001;

// The mean of the shortest edges of the faces in contact, before they are cut.
f64 spacing_of_contacts(const Workspace& w);

// Merged vertices may leave faces between old vertices that are part of no single old face: these have no origin.
// O(edits).
void forget_false_origins(Edit& e);

// `spacing`: of the faces that were cut. O(new vertices + faces round them).
void tidy_cut(Attempt& a, f64 spacing);

}  // namespace tpa
