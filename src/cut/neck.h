// SPDX-License-Identifier: MIT
// neck: a ring of surface in contact with itself runs round a neck of the body, round a hole through the body, or round
// a junction of several. Section 5 cuts a neck, and fills a hole, where "opposite" walls meet; a neck with a mere fold
// must stay. Winding numbers along the middle of the ring tell.
#pragma once

#include "cut/clusters.h"

namespace tpa {

// A front of the ring is a connected set of vertices equally far from the loops; each loop is a front as well.
struct Front {
  Vec3 middle;
  u32 size;    // vertices; of a loop its cuts
  u32 parent;  // in the disjoint sets of legs
  bool right;  // is the middle in the body, for a ring round a neck; or outside, for a ring round a hole?
  i8 facing;   // of a loop: 1 round a neck, -1 round a hole, 0 if unclear
};

// The place where a segment meets a triangle, as a share of the segment's length; rounded.
f64 place_along(const Vec3& p, const Vec3& q, const Triangle& triangle);

struct NeckScratch {
  u32* front = nullptr;  // per vertex of clusters: its front; none outside of the ring in hand
  u8* level = nullptr;   // per vertex: edges to the nearest loop with a clear facing, modulo 256
  Stack<u32> ring;       // as many as vertices
  Stack<Front> fronts;   // the loops come first
};

// Parts the loops of a ring, all vertices of one cluster, into legs: loops that stay connected get the same
// CutLoop::piece. Loops with faces that clearly look away from the loop's axis (neck) or towards it (hole) send fronts
// into the ring, all at once. The middles of the fronts, joined where fronts touch, are the ring's skeleton (Verroust
// and Lazarus 2000). The skeleton is cut where it leaves the body, for a neck, or enters the body, for a hole; legs are
// told apart wherever the skeleton forks. A ring with too many fronts, or with loops in disagreement, is too tangled to
// tell, and stays together. O(vertices of clusters + fronts * faces along a ray).
void part_legs(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, const Clusters& r, Span<CutLoop> loops,
               NeckScratch& s);

}  // namespace tpa
