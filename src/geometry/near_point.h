// SPDX-License-Identifier: MIT
// near_point: constructed points (geometry/constructed_point.h) in twice the precision of a double, with bounds on
// their errors: a filter before exact arithmetic.
#pragma once

#include "geometry/nearly.h"

namespace tpa {

// The points x with normal . (x - at) = 0.
struct NearPlane {
  Vec3 at;
  Nearly normal[3];
};
NearPlane near_plane(const Vec3& a, const Vec3& b, const Vec3& c);
// The plane through a and b that holds the direction of the axis.
NearPlane near_plane_along(const Vec3& a, const Vec3& b, u32 axis);

struct NearPoint {
  Nearly x[3];
};
NearPoint near_point(const Vec3& p);
// Where the line through a and b crosses a plane.
NearPoint near_line_through_plane(const Vec3& a, const Vec3& b, const NearPlane& plane);
// Where three planes meet.
NearPoint near_common_point(const NearPlane& a, const NearPlane& b, const NearPlane& c);

// Each coordinate rounded to nearest, as rounded() does. False where the filter cannot decide.
bool round_nearly(const NearPoint& p, Vec3& rounded, u32& exact);

// The sign of p[axis] - q[axis], or 2 where it is in doubt.
int near_compare_along(u32 axis, const NearPoint& p, const NearPoint& q);
// The turn of a, b, c as seen along an axis (geometry/predicates.h, flat_orient), or 2.
int near_flat_orient(u32 axis, const NearPoint& a, const NearPoint& b, const NearPoint& c);

}  // namespace tpa
