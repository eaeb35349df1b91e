// SPDX-License-Identifier: MIT
// approach: by how much points of the surface come nearer to each other on the ways to the targets. A part of the
// object, or of the space around, can only be crossed unseen if its two sides approach each other by its thickness or
// more.
#pragma once

#include "block/context.h"

namespace tpa {

// tpa_report.approach: on their ways to the targets, two points of the surface come nearer to each other by at most
// this length. Frozen vertices stay. O(vertices with targets).
f64 bound_of_approach(const Workspace& w);

// More than what rounded positions add to the approach within a sub-step. O(V).
f64 rounding_of_substeps(const Workspace& w);

// The number of equal parts of all ways with an approach below the thickness, what rounding adds included; at most
// 2^52, for any larger number, or if no number is enough. Pre: the approach is not below the thickness.
u64 substeps_for(f64 approach, f64 thickness, f64 rounding);

}  // namespace tpa
