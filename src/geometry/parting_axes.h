// SPDX-License-Identifier: MIT
// parting_axes: proofs that triangles do not meet, for four pairs at a time in single precision (section 3, ahead of
// the exact test). Triangles are apart if their extents along some direction are apart (separating axis theorem,
// Gottschalk, Lin & Manocha 1996). Any direction will do: the margin holds whatever the error of the direction itself,
// so needles and triangles in one plane are parted as well as others.
#pragma once

#include "base/simd.h"

namespace tpa {

// Triangles in lanes, by corner and axis, relative to a point common to all.
struct TriangleLanes {
  F4 corner[3][3];
};

// Directions tried for one triangle: the normal of its plane and, along the plane, the normals of its edges.
struct PartingAxes {
  f32 normal[3], edge[3][3];
};

namespace parting_detail {

struct Extent {
  F4 low, high;
};
inline F4 place_along(const F4 (&axis)[3], const F4 (&p)[3]) {
  return axis[0] * p[0] + axis[1] * p[1] + axis[2] * p[2];
}
inline Extent extent_along(const F4 (&axis)[3], const TriangleLanes& t) {
  const F4 x = place_along(axis, t.corner[0]), y = place_along(axis, t.corner[1]), z = place_along(axis, t.corner[2]);
  return {min4(x, min4(y, z)), max4(x, max4(y, z))};
}

inline void set_cross(F4 (&c)[3], const F4 (&a)[3], const F4 (&b)[3]) {
#pragma GCC unroll 3
  for (u32 k = 0; k < 3; ++k) c[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}
inline void set_difference(F4 (&c)[3], const F4 (&a)[3], const F4 (&b)[3]) {
#pragma GCC unroll 3
  for (u32 k = 0; k < 3; ++k) c[k] = a[k] - b[k];
}

}  // namespace parting_detail

inline void set_normal(F4 (&normal)[3], const TriangleLanes& t) {
  F4 u[3], v[3];
  parting_detail::set_difference(u, t.corner[1], t.corner[0]);
  parting_detail::set_difference(v, t.corner[2], t.corner[0]);
  parting_detail::set_cross(normal, u, v);
}
inline void set_edge_normal(F4 (&across)[3], const TriangleLanes& t, const F4 (&normal)[3], u32 i) {
  F4 edge[3];
  parting_detail::set_difference(edge, t.corner[(i + 1) % 3], t.corner[i]);
  parting_detail::set_cross(across, edge, normal);
}

// Pre: one triangle in all lanes.
inline PartingAxes parting_axes_of(const TriangleLanes& t) {
  F4 normal[3], across[3];
  PartingAxes axes;
  set_normal(normal, t);
  for (u32 k = 0; k < 3; ++k) axes.normal[k] = normal[k][0];
  for (u32 i = 0; i < 3; ++i) {
    set_edge_normal(across, t, normal, i);
    for (u32 k = 0; k < 3; ++k) axes.edge[i][k] = across[k][0];
  }
  return axes;
}

// Bound of the error of two places along a direction with components up to 1, for points of magnitude up to 1 known to
// 2^-25, relative to one of them and no farther off than `reach`. A point is off by 2^-25, its difference by another
// 2^-24 of the reach, and a sum of three products by three times as much: for two points and three components, by less
// than 2^-24 (3 + 25 reach) in all.
inline f32 parting_doubt(f32 reach) { return 0x1p-24f * (4 + 26 * reach); }

// Lanes in which a direction certainly parts the triangles. Directions with tiny components prove nothing: underflow
// would outweigh the margin.
inline I4 are_parted(const F4 (&axis)[3], const TriangleLanes& a, const TriangleLanes& b, const F4& doubt) {
  const F4 size = max4(abs_of(axis[0]), max4(abs_of(axis[1]), abs_of(axis[2]))), margin = doubt * size;
  const parting_detail::Extent of_a = parting_detail::extent_along(axis, a),
                               of_b = parting_detail::extent_along(axis, b);
  return ((of_b.low - of_a.high > margin) | (of_a.low - of_b.high > margin)) & (size > all4(0x1p-60f));
}

// Lanes of `left` that no direction of a or of b parts. `of_a`: of the one triangle a.
inline u32 lanes_not_parted(const TriangleLanes& a, const PartingAxes& of_a, const TriangleLanes& b, const F4& doubt,
                            u32 left) {
  const auto part = [&](const F4(&axis)[3]) { left &= ~bits_of(are_parted(axis, a, b, doubt)); };
  const auto part_along = [&](const f32(&axis)[3]) {
    const F4 in_lanes[3] = {all4(axis[0]), all4(axis[1]), all4(axis[2])};
    part(in_lanes);
  };
  part_along(of_a.normal);
  if (left == 0) return 0;
  for (u32 i = 0; i < 3; ++i) part_along(of_a.edge[i]);
  if (left == 0) return 0;
  F4 normal[3], across[3];
  set_normal(normal, b);
  part(normal);
  if (left == 0) return 0;
  for (u32 i = 0; i < 3; ++i) {
    set_edge_normal(across, b, normal, i);
    part(across);
  }
  return left;
}

}  // namespace tpa
