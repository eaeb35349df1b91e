// SPDX-License-Identifier: MIT
// parting_axes: proofs that triangles do not meet, for four pairs at a time in single precision (section 3, ahead of
// the exact test). Triangles are apart if their extents along some direction are apart (separating axis theorem,
// Gottschalk, Lin & Manocha 1996). Any direction will do: the margin holds whatever the error of the direction itself,
// so needles and triangles in one plane are parted as well as others.
#pragma once

#include <float.h>

#include "base/simd.h"

namespace tpa {

// Triangles in lanes, by corner and axis, relative to a point common to all.
struct TriangleLanes {
  F4 corner[3][3];
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

// Bound of the error of two places along a direction with components up to 1, for points of magnitude up to 1 known to
// 2^-25, relative to one of them and no farther off than `reach`. A point is off by 2^-25, its difference by another
// 2^-24 of the reach, the three products of a sum by three, three and two times as much, and a bound with its margin by
// three times as much: for two points and three components, by less than 2^-24 (3 + 26 reach) in all.
inline f32 parting_doubt(f32 reach) { return 0x1p-24f * (4 + 26 * reach); }

// Margin for a direction. Tiny components prove nothing, since underflow would outweigh any margin.
inline F4 parting_margin(const F4 (&axis)[3], f32 doubt) {
  const F4 size = max4(abs_of(axis[0]), max4(abs_of(axis[1]), abs_of(axis[2])));
  return chosen(size > all4(0x1p-60f), doubt * size, all4(FLT_MAX));
}

// A triangle in all lanes, relative to its first corner, with the directions that may part it from others: the normal
// of its plane and, along the plane, the normals of its edges.
struct PartingProbe {
  F4 origin[3];
  TriangleLanes triangle;
  f32 doubt;
  F4 axis[4][3], below[4], above[4];  // places along the directions that others must not reach
};

// Pre: one triangle in all lanes; no point of another triangle is farther from its first corner than `reach`.
inline void set_probe(PartingProbe& p, const TriangleLanes& t, f32 reach) {
  for (u32 k = 0; k < 3; ++k) p.origin[k] = t.corner[0][k];
  for (u32 i = 0; i < 3; ++i) parting_detail::set_difference(p.triangle.corner[i], t.corner[i], p.origin);
  p.doubt = parting_doubt(reach);
  set_normal(p.axis[3], p.triangle);
  for (u32 i = 0; i < 3; ++i) set_edge_normal(p.axis[i], p.triangle, p.axis[3], i);
  for (u32 i = 0; i < 4; ++i) {
    const F4 margin = parting_margin(p.axis[i], p.doubt);
    const parting_detail::Extent own = parting_detail::extent_along(p.axis[i], p.triangle);
    p.below[i] = own.low - margin;
    p.above[i] = own.high + margin;
  }
}

// Lanes of `left` with triangles that no direction certainly parts from the triangle of the probe.
inline u32 lanes_not_parted(const PartingProbe& p, const TriangleLanes& others, u32 left) {
  TriangleLanes t;
  for (u32 i = 0; i < 3; ++i) parting_detail::set_difference(t.corner[i], others.corner[i], p.origin);
  for (u32 i = 4; i-- > 0 && left != 0;) {
    const parting_detail::Extent of_t = parting_detail::extent_along(p.axis[i], t);
    left &= ~bits_of((of_t.low > p.above[i]) | (of_t.high < p.below[i]));
  }
  if (left == 0) return 0;
  F4 normal[3], across[3];
  const auto part = [&](const F4(&axis)[3]) {
    const F4 margin = parting_margin(axis, p.doubt);
    const parting_detail::Extent own = parting_detail::extent_along(axis, p.triangle),
                                 of_t = parting_detail::extent_along(axis, t);
    left &= ~bits_of((of_t.low - own.high > margin) | (own.low - of_t.high > margin));
  };
  set_normal(normal, t);
  part(normal);
  for (u32 i = 0; i < 3 && left != 0; ++i) {
    set_edge_normal(across, t, normal, i);
    part(across);
  }
  return left;
}

}  // namespace tpa
