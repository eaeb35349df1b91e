// SPDX-License-Identifier: MIT
// trial_fences: planes that part the trial faces of an operation from most faces round it (sections 5 and 7). The box
// of a needle meets half the needles of its fan. Most of them are coplanar, where the exact test of a pair is slow.
//
// A fence stands along the direction of sight, on the line through two trial corners a and b, moved outward to the
// farthest trial corner where rounding leaves that in doubt. No trial face reaches beyond. A face with all corners
// strictly beyond meets no trial face. If all trial corners but a and b lie certainly inside, a and b may be corners of
// the face, too: on the fence the face has nothing but these, or the edge between them, and so has each trial face.
#pragma once

#include "detect/near_faces.h"
#include "mesh/projection.h"

namespace tpa {

struct Fence {
  u32 a, b;        // vertices; none if another trial corner may lie on the line or beyond
  Point from, to;  // a and b as seen
  f64 farthest;    // no trial corner has a larger turn
};

// Bounds of trial faces along a direction, in tree units, doubts included.
struct TrialExtent {
  Vec3 axis, size;  // `size` has the absolute values
  f64 low, high;
};

struct TrialFences {
  static constexpr u32 most = 8;  // the longest sides of the convex hull
  View view;
  u32 count, extents;
  Fence fence[most];
  TrialExtent extent[most + 1];  // across the fences and along the normal
};

// Different corners of trial faces; none if there are too many.
struct TrialCorners {
  static constexpr u32 most = 50;
  u32 count, vertex[most];
};

// Fences round the trial faces of a set, for a view along the axis closest to the normal. O(corners^2).
void make_fences(TrialFences& s, TrialCorners& corners, const Mesh& m, const NearFaces& g, const FaceCorners* trials,
                 u64 set, const Vec3& normal);
// Is it certain that a face meets no trial face of the set?
bool is_beyond_fence(const TrialFences& s, const Mesh& m, const u32* corner);
// Is it certain that no trial face of the set meets a box, in tree units?
bool is_box_beyond(const TrialFences& s, const Box& box);

}  // namespace tpa
