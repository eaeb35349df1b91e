// SPDX-License-Identifier: MIT
// close_tunnels: handles and tunnels that the exact cut of a step has made, thinner than the triangles that it cut. A
// seam moves with one body, and the other body's triangles turn about it: they cross the first body here, and miss it
// there. The region of the moved mesh has such tunnels, but no body of this sampling does (P3), and each further step
// would make more. A loop round each is cut, and capped on both sides.
#pragma once

#include "step/tidy_cut.h"

namespace tpa {

// Loops round tunnels and handles are at most so many sizes of triangles long. Even triangles make tunnels with a waist
// of four edges, slender ones beside them wider ones. A handle of the mesh itself may be as thin.
inline constexpr f64 tunnel_share = 8, handle_share = 4;
// Round a flat tunnel, so many of the longest edges.
inline constexpr f64 flat_share = 4;

// The share of the volume of all bodies by which caps may change the region.
inline constexpr f64 closing_share = 0.01;

// Loops near a vertex that are tried to be cut, until one can be.
inline constexpr u32 most_loops_cut = 4;

// Closes at most as many as there are more handles than before the step, then drops specks again. Blocked never; out of
// room, or stopped, else clean. O(V + vertices near new ones).
Outcome close_tunnels(Attempt& a, const CutSizes& sizes);

}  // namespace tpa
