// SPDX-License-Identifier: MIT
// constructed_point: exact points where lines and planes meet, and exact questions about them (Attene 2020, indirect
// predicates; Levy 2024 for homogeneous coordinates). Planes and lines are given by points with double coordinates.
#pragma once

#include "base/vec3.h"
#include "geometry/dyadic.h"

namespace tpa {

// The points x with normal . (x - at) = 0.
struct ExactPlane {
  Vec3 at;
  Dyadic<2> normal[3];
};
// The plane of a triangle with area; the normal is (b - a) x (c - a).
ExactPlane exact_plane(const Vec3& a, const Vec3& b, const Vec3& c);
// The plane through a and b that holds the direction of the axis.
ExactPlane exact_plane_along(const Vec3& a, const Vec3& b, u32 axis);

// The point (x[0], x[1], x[2]) / w, w not zero.
struct ExactPoint {
  Dyadic<7> x[3];
  Dyadic<6> w;
};
ExactPoint exact_point(const Vec3& p);
// Where the line through a and b crosses a plane. Pre: the line is not parallel to the plane.
ExactPoint line_through_plane(const Vec3& a, const Vec3& b, const ExactPlane& plane);
// Where three planes meet. Pre: in a single point.
ExactPoint common_point(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c);

// Each coordinate rounded to the nearest double. Equal points give equal coordinates; coordinates keep their order.
// Bit i of `exact`: coordinate i is that double.
Vec3 rounded(const ExactPoint& p, u32& exact);

// The sign of p[axis] - q[axis].
int compare_along(u32 axis, const ExactPoint& p, const ExactPoint& q);
bool equal(const ExactPoint& p, const ExactPoint& q);

// The turn of a, b, c as seen along an axis: +1 counterclockwise (geometry/predicates.h, flat_orient).
int flat_orient(u32 axis, const ExactPoint& a, const ExactPoint& b, const ExactPoint& c);

// The sign of component `axis` of the cross product of the normals of two planes.
int cross_sign(u32 axis, const ExactPlane& a, const ExactPlane& b);
// The sign of the dot product of the normals of two planes.
int dot_sign(const ExactPlane& a, const ExactPlane& b);

// A line along the axis through p crosses both planes. The sign of the difference of the crossings along the axis, a's
// less b's. Pre: neither plane holds the direction of the axis.
int compare_heights(u32 axis, const Vec3& p, const ExactPlane& a, const ExactPlane& b);

}  // namespace tpa
