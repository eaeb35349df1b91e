// SPDX-License-Identifier: MIT
// bisect: halving faces at the longest edge (Rivara 1997), so that shapes stay good. Remeshing halves long
// edges.
#pragma once

#include "detect/near_faces.h"
#include "edit/edge_aims.h"
#include "mesh/journal.h"

namespace tpa {

// Puts v, still without edges, on the half-edge h and cuts the two faces at h in two. False if faces run out; the mesh
// is unchanged then.
bool split_edge(Edit& e, NearFaces& near, u32 h, u32 v);

// Walks from h to ever longer edges of neighbouring faces, and returns the first edge that is the longest in both
// faces. Only such edges are split: other splits would turn long thin faces into more of the same, without end. Lengths
// are parts of the aims, and only chosen edges count.
u32 locally_longest(const Mesh& m, const EdgeAims& aims, u32 h);

// The number of living faces if all edges too long for the aims are split so: not less, unless rounding decides. From
// 16 times as many faces and a million more on an estimate. O(that number).
u64 most_faces_bisected(const Mesh& m, const EdgeAims& aims);

}  // namespace tpa
