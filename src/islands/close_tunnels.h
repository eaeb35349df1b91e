// SPDX-License-Identifier: MIT
// close_tunnels: handles and tunnels that an island of a step has made, thinner than the triangles in contact. A seam
// moves with one body, and the other body's triangles turn about it: they cross the first body here, and miss it there.
// The region of the moved mesh has such tunnels, but no body of this sampling does (P3), and each further step would
// make more. A loop round each is cut, and capped on both sides.
#pragma once

#include "islands/tidy_cut.h"

namespace tpa {

// Closes at most `made`, as many handles as there are more than before the island (handles_made()), within its ledger,
// then drops specks again. Blocked never; out of room, or stopped, else clean. O(vertices near new ones).
Outcome close_tunnels(Attempt& a, const CutSizes& sizes, i64 made);

}  // namespace tpa
