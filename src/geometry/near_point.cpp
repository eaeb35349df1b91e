// SPDX-License-Identifier: MIT
#include "geometry/near_point.h"

namespace tpa {

namespace {

constexpr u32 next_axis(u32 axis) { return axis == 2 ? 0 : axis + 1; }

struct NearVector {
  Nearly at[3];
};
NearVector near_difference(const Vec3& a, const Vec3& b) {
  return {{nearly_difference(a.x, b.x), nearly_difference(a.y, b.y), nearly_difference(a.z, b.z)}};
}

Nearly dot(const Nearly (&a)[3], const Nearly (&b)[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Points of a plane that is square to an axis have the plane's own coordinate, exactly.
void take_level(const NearPlane& plane, NearPoint& point) {
  for (u32 i = 0; i < 3; ++i)
    if (is_exact_zero(plane.normal[next_axis(i)]) && is_exact_zero(plane.normal[next_axis(next_axis(i))]))
      point.x[i] = nearly(plane.at[static_cast<int>(i)]);
}

NearVector cross(const Nearly (&a)[3], const Nearly (&b)[3]) {
  NearVector out;
  for (u32 i = 0; i < 3; ++i) {
    const u32 j = next_axis(i), k = next_axis(j);
    out.at[i] = a[j] * b[k] - a[k] * b[j];
  }
  return out;
}

}  // namespace

NearPlane near_plane(const Vec3& a, const Vec3& b, const Vec3& c) {
  const NearVector n = cross(near_difference(b, a).at, near_difference(c, a).at);
  return {a, {n.at[0], n.at[1], n.at[2]}};
}

NearPlane near_plane_along(const Vec3& a, const Vec3& b, u32 axis) {
  const NearVector u = near_difference(b, a);
  const u32 j = next_axis(axis), k = next_axis(j);
  NearPlane plane{a, {}};
  plane.normal[j] = u.at[k];
  plane.normal[k] = -u.at[j];
  return plane;
}

NearPoint near_point(const Vec3& p) { return {{nearly(p.x), nearly(p.y), nearly(p.z)}}; }

// a + t (b - a) with t = normal . (at - a) / normal . (b - a).
NearPoint near_line_through_plane(const Vec3& a, const Vec3& b, const NearPlane& plane) {
  const NearVector way = near_difference(b, a);
  const Nearly t = dot(plane.normal, near_difference(plane.at, a).at) / dot(plane.normal, way.at);
  NearPoint out;
  for (u32 i = 0; i < 3; ++i) out.x[i] = nearly(a[static_cast<int>(i)]) + t * way.at[i];
  take_level(plane, out);
  return out;
}

// Cramer's rule, with the origin moved to a.at.
NearPoint near_common_point(const NearPlane& a, const NearPlane& b, const NearPlane& c) {
  const NearVector bc = cross(b.normal, c.normal), ca = cross(c.normal, a.normal), ab = cross(a.normal, b.normal);
  const Nearly w = dot(a.normal, bc.at);
  const Nearly level_b = dot(b.normal, near_difference(b.at, a.at).at),
               level_c = dot(c.normal, near_difference(c.at, a.at).at);
  NearPoint out;
  for (u32 i = 0; i < 3; ++i)
    out.x[i] = nearly(a.at[static_cast<int>(i)]) + (level_b * ca.at[i] + level_c * ab.at[i]) / w;
  take_level(a, out);
  take_level(b, out);
  take_level(c, out);
  return out;
}

bool round_nearly(const NearPoint& p, Vec3& rounded, u32& exact) {
  exact = 0;
  for (u32 i = 0; i < 3; ++i) {
    const Nearly& x = p.x[i];
    const f64 size = abs_of(x.high);
    if (is_exact_double(x) && in_exact_range(x.high))
      exact |= 1u << i;
    else if (!is_rounded(x) || !(size > 2 * smallest_magnitude) || !(size < largest_magnitude))
      return false;
    rounded[static_cast<int>(i)] = x.high + 0.0;  // no negative zero
  }
  return true;
}

int near_compare_along(u32 axis, const NearPoint& p, const NearPoint& q) { return nearly_sign(p.x[axis] - q.x[axis]); }

int near_flat_orient(u32 axis, const NearPoint& a, const NearPoint& b, const NearPoint& c) {
  const u32 u = next_axis(axis), v = next_axis(u);
  return nearly_sign((b.x[u] - a.x[u]) * (c.x[v] - a.x[v]) - (b.x[v] - a.x[v]) * (c.x[u] - a.x[u]));
}

}  // namespace tpa
