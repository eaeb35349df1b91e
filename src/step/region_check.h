// SPDX-License-Identifier: MIT
// region_check: how much a step in the paper's way has changed the region that the moved mesh bounds
// (docs/exact-cut.md).
#pragma once

#include "step/attempt.h"

namespace tpa {

// The largest change of the region's volume in the paper's way, as a share of the clusters' areas to the power 3/2.
inline constexpr f64 small_change = 0.15;

// The same as a share of the volume of all bodies, in steps that move most vertices.
inline constexpr f64 small_share = 0.005;

// Six times the volume of all bodies, voids taken off. O(V).
f64 six_volumes(const Mesh& m);

// The faces that went, as they had moved, and the faces made.
struct RegionChange {
  f64 volume = 0;  // enclosed afterwards less enclosed by the moved mesh
  f64 area = 0;    // of the faces that went
  u32 faces = 0;   // that went
};

// Compares the mesh with the moved mesh of the transaction, by the faces changed since and the faces round vertices
// moved since. O(edits).
RegionChange region_change(const Workspace& w);

}  // namespace tpa
