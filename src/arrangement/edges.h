// SPDX-License-Identifier: MIT
// edges: the edges of the pieces, each with its pieces in the order in which they follow each other round the edge.
#pragma once

#include "arrangement/arrangement.h"

namespace tpa {

// The first half-edge of the edge between two points, or none.
u32 find_edge(const Arrangement& a, u32 p, u32 q);

// Does the half-edge run from the lower point to the higher? Then its piece's front looks counter-clockwise round the
// edge, seen against the direction from the lower point to the higher.
inline bool runs_upward(const Arrangement& a, u32 h) { return point_at_tail(a, h) < point_at_head(a, h); }

// Links all edges. False for a contradiction, or if the meter stops. O(pieces), and sorting round the edges of more
// than two pieces.
bool link_edges(Arrangement& a);

}  // namespace tpa
