// SPDX-License-Identifier: MIT
// region_check: how much a step in the paper's way has changed the region that the moved mesh bounds
// (docs/exact-cut.md).
#pragma once

#include "step/attempt.h"

namespace tpa {

// The largest change of the region's volume in the paper's way, as a share of the clusters' areas to the power 3/2.
inline constexpr f64 small_change = 0.25;

// The same as a share of the volume of all bodies, in steps that move most vertices; and where the triangles that go
// are much larger than the others: there an event of the paper changes more of a body than its sampling tells.
inline constexpr f64 small_share = 0.036, least_share = 0.01;

// Triangles of even meshes are at most so many times as large as their mean (subdivided octahedra, projected to a
// sphere, have 1.65).
inline constexpr f64 even_factor = 2;

// Six times the volume of all bodies, voids taken off. O(V).
f64 six_volumes(const Mesh& m, const Exec& exec);

// Has the transaction kept the region of the moved mesh, but for a small change? Writes the change: volumes by
// connected parts of the change; measured by samples all over the change where clusters are large against the bodies.
// `reach` bounds how far changes lie from faces in contact: changed faces lie between clusters and new vertices. Needs
// all faces of attempts in the paper's way. Overwrites work_vertices. O(edits) if the step moves few vertices, else
// O(V).
bool is_small_change(Attempt& a, RegionChange& change);

}  // namespace tpa
