// neck: a ring of the surface that meets itself runs round a neck of the body, or round a hole through it, or round
// where several of these come together. Section 5 cuts a neck and fills a hole where "opposite" walls meet; where a
// crease round a neck only folds over, the neck must stay. Winding numbers along the middle of the ring tell.
#pragma once

#include "cut/clusters.h"

namespace tpa {

// What a front of the ring has in its middle: a connected set of vertices that are equally far from the loops.
struct Front {
  Vec3 middle;
  u32 size;    // vertices; of a loop its cuts
  u32 parent;  // in the union-find of what hangs together
  bool right;  // is the middle in the body where the ring runs round a neck, in space where it runs round a hole?
  i8 facing;   // of a loop: 1 round a neck, -1 round a hole, 0 where that is not clear
};

// Of a segment that meets a triangle: how far along it does, as a share of its length.
f64 place_along(const Vec3& p, const Vec3& q, const Triangle& triangle);

struct NeckScratch {
  u32* front = nullptr;  // per vertex of clusters: none outside of the ring in hand
  u8* level = nullptr;   // per vertex: edges to the nearest loop that has a front, modulo 256
  Stack<u32> ring;       // as many as vertices
  Stack<Front> fronts;   // the loops come first
};

// Of a ring, the vertices of one cluster, and the loops that bound it: which loops hang together? Writes the same
// CutLoop::piece for those that do. Where the faces along the loops tell whether the ring runs round a neck or a hole,
// fronts go from these loops at once into the ring. Their middles, joined where the fronts touch, are the ring's
// skeleton (Verroust and Lazarus 2000). It is cut where it leaves the body that the ring runs round, or the space. Legs
// are told apart wherever the skeleton forks. What has more fronts than there is room for, or whose loops do not agree,
// is too tangled to tell, and stays together.
// O(vertices of clusters + fronts * faces along a ray).
void part_legs(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, const Clusters& r, Span<CutLoop> loops,
               NeckScratch& s);

}  // namespace tpa
