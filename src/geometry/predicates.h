// SPDX-License-Identifier: MIT
// predicates: exact answers about points and triangles, the ground of every judgement about contact (P1; paper section
// 3). Exact for coordinates that are zero or of magnitude within [2^-100, 2^100] (base/fp.h). A floating-point filter,
// inline, decides all but nearly degenerate cases; expansion arithmetic, out of line, the rest (Shewchuk 1997).
//
// Triangles and segments are closed point sets: touching counts as meeting, and a triangle with collinear or equal
// corners is the segment or the point covered.
#pragma once

#include "base/simd.h"
#include "base/vec3.h"

namespace tpa {

int orient2d_exact(f64 ax, f64 ay, f64 bx, f64 by, f64 cx, f64 cy);
int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// Sign of a computed determinant, or 2 where the rounding error may decide. A bound of zero means that every term is an
// exact zero, since nothing underflows. No branch on the sign, which is as good as random.
constexpr int filtered_sign(f64 determinant, f64 bound) {
  const int sign = (determinant > bound) - (determinant < -bound);
  return sign + 2 * ((sign == 0) & (bound != 0));
}

// Sign of the area of abc: +1 counterclockwise, 0 collinear.
// Each term of the determinant carries at most four roundings (two differences, product, last subtraction), so the
// error is below 4.01 * 2^-53 times the sum of the terms' magnitudes; 5 covers the rounding of the bound itself.
inline int orient2d(f64 ax, f64 ay, f64 bx, f64 by, f64 cx, f64 cy) {
  const f64 left = (bx - ax) * (cy - ay);
  const f64 right = (by - ay) * (cx - ax);
  const int sign = filtered_sign(left - right, 5 * 0x1p-53 * (abs_of(left) + abs_of(right)));
  return sign != 2 ? sign : orient2d_exact(ax, ay, bx, by, cx, cy);
}

// orient2d along an axis: the axis is dropped, and the other two keep their cyclic order.
int flat_orient(int axis, const Vec3& a, const Vec3& b, const Vec3& c);

// The part of orient3d that depends on the plane abc only, for several questions about a plane. The caller keeps the
// three points in place.
struct Plane {
  const Vec3 *a, *b, *c;
  Vec3 normal;     // (b - a) x (c - a), rounded
  Vec3 magnitude;  // by component: the sum of its terms' absolute values
};

// Normal and magnitude of a plane, or of two planes in lanes, from two edges.
template <class V>
struct NormalOf {
  V normal, magnitude;
};
template <class V>
inline NormalOf<V> normal_of(const V& u, const V& v) {
  const auto yz = u.y * v.z, zy = u.z * v.y, zx = u.z * v.x, xz = u.x * v.z, xy = u.x * v.y, yx = u.y * v.x;
  return {{yz - zy, zx - xz, xy - yx}, {abs_of(yz) + abs_of(zy), abs_of(zx) + abs_of(xz), abs_of(xy) + abs_of(yx)}};
}

inline Plane plane_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const NormalOf<Vec3> n = normal_of(b - a, c - a);
  return {&a, &b, &c, n.normal, n.magnitude};
}

// normal . (d - a), for a point d or for two in lanes, with a bound on its error. Each of the six terms carries at most
// eight roundings (three differences, two products, three additions), so the error is below 8.01 * 2^-53 times the sum
// of the terms' true magnitudes. The computed sum is low by at most the same share of the true sum; 9 covers both.
template <class T>
struct Height {
  T value, doubt;
};
template <class V, class T>
inline Height<T> height_along(const V& n, const V& m, const T& x, const T& y, const T& z) {
  return {n.x * x + n.y * y + n.z * z, 9 * 0x1p-53 * (m.x * abs_of(x) + m.y * abs_of(y) + m.z * abs_of(z))};
}
template <class T>
inline Height<T> height_above(const Plane& plane, const T& dx, const T& dy, const T& dz) {
  const Vec3& a = *plane.a;
  const T x = dx - a.x, y = dy - a.y, z = dz - a.z;
  return height_along(plane.normal, plane.magnitude, x, y, z);
}

// Sign of the height of d above the plane, or 2 where the filter cannot decide.
inline int filtered_side(const Plane& plane, const Vec3& d) {
  const Height<f64> h = height_above(plane, d.x, d.y, d.z);
  return filtered_sign(h.value, h.doubt);
}
// The exact sign, for a filter's answer `sign`.
inline int decided(const Plane& plane, const Vec3& d, int sign) {
  return sign != 2 ? sign : orient3d_exact(*plane.a, *plane.b, *plane.c, d);
}

// Points that the filter has above a plane, and below: bit i for the point i.
struct CertainSides {
  u32 above, below;
};
inline void note_side(CertainSides& s, u32 point, int side) {
  s.above |= u32{side == 1} << point, s.below |= u32{side == -1} << point;
}
#if defined(TPA_VECTORS)
inline CertainSides certain_sides(const Plane& plane, const Vec3& d, const Vec3& e) {
  const Height<D2> h = height_above(plane, D2{d.x, e.x}, D2{d.y, e.y}, D2{d.z, e.z});
  return {bits_of_two(h.value > h.doubt), bits_of_two(h.value < -h.doubt)};
}
inline CertainSides certain_sides(const Plane& plane, const Vec3& d, const Vec3& e, const Vec3& f) {
  const CertainSides first = certain_sides(plane, d, e);
  const Height<f64> h = height_above(plane, f.x, f.y, f.z);
  return {first.above | u32{h.value > h.doubt} << 2, first.below | u32{h.value < -h.doubt} << 2};
}

// Two planes in lanes, and a point for each; the bounds above hold lane by lane.
struct TwoPoints {
  D2 x, y, z;
};
inline TwoPoints two_points(const Vec3& p, const Vec3& q) { return {D2{p.x, q.x}, D2{p.y, q.y}, D2{p.z, q.z}}; }
inline TwoPoints operator-(const TwoPoints& a, const TwoPoints& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }

struct TwoPlanes {
  TwoPoints a;
  NormalOf<TwoPoints> of;
};
inline TwoPlanes planes_of(const TwoPoints& a, const TwoPoints& b, const TwoPoints& c) {
  return {a, normal_of(b - a, c - a)};
}
inline Height<D2> heights_above(const TwoPlanes& planes, const TwoPoints& d) {
  const TwoPoints at = d - planes.a;
  return height_along(planes.of.normal, planes.of.magnitude, at.x, at.y, at.z);
}
#else
template <class... Points>
CertainSides certain_sides(const Plane& plane, const Points&... points) {
  CertainSides s{};
  const Vec3* const all[] = {&points...};
  for (u32 i = 0; i < sizeof...(points); ++i) note_side(s, i, filtered_side(plane, *all[i]));
  return s;
}
#endif

inline int side_of(const Plane& plane, const Vec3& d) { return decided(plane, d, filtered_side(plane, d)); }

// +1 for d on the side that the normal (b - a) x (c - a) points to, -1 on the other side, 0 in the plane. Always 0 for
// a degenerate abc.
inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return side_of(plane_of(a, b, c), d);
}

bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);

bool triangles_meet(const Triangle& a, const Triangle& b);

// The sides of b's corners about the plane of a, and of a's corners about the plane of b, as far as the filter tells.
struct FacingSides {
  CertainSides of_b, of_a;
};
FacingSides facing_sides(const Triangle& a, const Triangle& b);

// Do the triangles (v, a1, a2) and (v, b1, b2) share a point besides v?
bool triangles_meet_beyond_vertex(const Vec3& v, const Vec3& a1, const Vec3& a2, const Vec3& b1, const Vec3& b2);

// Do the triangles (u, v, oa) and (v, u, ob) share a point off the closed segment uv, or have two corners in one place?
// (Nothing else would be seen of a tetrahedron with three corners in one place.)
bool triangles_meet_beyond_edge(const Vec3& u, const Vec3& v, const Vec3& oa, const Vec3& ob);

}  // namespace tpa
