// predicates: exact answers about points and triangles. Every judgement about contact rests on them (P1).
// Exact for coordinates that are zero or of magnitude within [2^-100, 2^100] (base/fp.h). First a floating-point
// filter, inline, that decides all but nearly degenerate cases; then expansion arithmetic, out of line
// (Shewchuk 1997).
//
// Triangles and segments are closed point sets: touching counts as meeting, and a triangle whose corners are
// collinear or equal is the segment or the point that it covers.
#pragma once

#include "base/simd.h"
#include "base/vec3.h"

namespace tpa {

int orient2d_exact(f64 ax, f64 ay, f64 bx, f64 by, f64 cx, f64 cy);
int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);

// Sign of a computed determinant, or 2 where its rounding error may decide. A bound of zero means that every
// term is an exact zero, since nothing underflows. Free of branches on the sign, which is as good as random.
constexpr int filtered_sign(f64 determinant, f64 bound) {
  const int sign = (determinant > bound) - (determinant < -bound);
  return sign + 2 * ((sign == 0) & (bound != 0));
}

// Sign of the area of abc: +1 counterclockwise, 0 collinear.
// Each term of the determinant carries at most four roundings (two differences, product, last subtraction),
// so the error is below 4.01 * 2^-53 times the sum of their magnitudes; 5 covers the rounding of the bound
// itself.
inline int orient2d(f64 ax, f64 ay, f64 bx, f64 by, f64 cx, f64 cy) {
  const f64 left = (bx - ax) * (cy - ay);
  const f64 right = (by - ay) * (cx - ax);
  const int sign = filtered_sign(left - right, 5 * 0x1p-53 * (abs_of(left) + abs_of(right)));
  return sign != 2 ? sign : orient2d_exact(ax, ay, bx, by, cx, cy);
}

// The part of orient3d that depends on the plane abc only, for callers that ask about several points, and keep the
// three where they are.
struct Plane {
  const Vec3 *a, *b, *c;
  Vec3 normal;     // (b - a) x (c - a), rounded
  Vec3 magnitude;  // the same with every term's absolute value, added
};

// Of one plane, or of two in lanes, from two edges each.
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

// normal . (d - a), of one point d, or of two in lanes, and what that may be off by. Each of the six terms carries at
// most eight roundings (three differences, two products, three additions), so the error is below 8.01 * 2^-53 times the
// sum of their true magnitudes; the computed sum is low by as much again at most.
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

// Its sign: exact, or filtered, where 2 stands for undecided.
inline int filtered_side(const Plane& plane, const Vec3& d) {
  const Height<f64> h = height_above(plane, d.x, d.y, d.z);
  return filtered_sign(h.value, h.doubt);
}
// The sign itself, where the filter has said `sign`.
inline int decided(const Plane& plane, const Vec3& d, int sign) {
  return sign != 2 ? sign : orient3d_exact(*plane.a, *plane.b, *plane.c, d);
}

// Which of some points the filter has above a plane and which below: bit i for the point i.
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
  const CertainSides two = certain_sides(plane, d, e);
  const Height<f64> h = height_above(plane, f.x, f.y, f.z);
  return {two.above | u32{h.value > h.doubt} << 2, two.below | u32{h.value < -h.doubt} << 2};
}

// Two planes, and a point for each of them: what has been said of one holds in each lane.
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
// One by one.
template <class... Points>
CertainSides certain_sides(const Plane& plane, const Points&... points) {
  CertainSides s{};
  const Vec3* const all[] = {&points...};
  for (u32 i = 0; i < sizeof...(points); ++i) note_side(s, i, filtered_side(plane, *all[i]));
  return s;
}
#endif

inline int side_of(const Plane& plane, const Vec3& d) { return decided(plane, d, filtered_side(plane, d)); }

// +1 if d lies on the side that the normal (b - a) x (c - a) points to, -1 on the other, 0 in the plane.
// Always 0 when abc is degenerate.
inline int orient3d(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return side_of(plane_of(a, b, c), d);
}

bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c);

// How the segment pq meets the triangle t: from the side that the normal points to through the inside, the other way,
// not at all, or in some other way (an end on the triangle, or a point on its rim).
enum class Passage : u8 { misses, enters, leaves, touches };
Passage segment_through_triangle(const Vec3& p, const Vec3& q, const Triangle& t);
// The same of a segment whose ends lie on different sides of the triangle's plane: `from_above`, p above it.
Passage passage_across(const Vec3& p, const Vec3& q, const Triangle& t, bool from_above);

bool triangles_meet(const Triangle& a, const Triangle& b);

// On which side of the plane of a the corners of b are, and those of a of the plane of b, as far as the filter tells.
struct FacingSides {
  CertainSides of_b, of_a;
};
FacingSides facing_sides(const Triangle& a, const Triangle& b);

// Do the triangles (v, a1, a2) and (v, b1, b2) share a point besides v?
bool triangles_meet_beyond_vertex(const Vec3& v, const Vec3& a1, const Vec3& a2, const Vec3& b1, const Vec3& b2);

// Do the triangles (u, v, oa) and (v, u, ob) share a point off the closed segment uv?
bool triangles_meet_beyond_edge(const Vec3& u, const Vec3& v, const Vec3& oa, const Vec3& ob);

// Winding numbers by rays in +x. The ray from p starts at p + (0, eps, eps^2) with eps > 0 and infinitely
// small (simulation of simplicity, Edelsbrunner & Muecke 1990), so it passes through no edge and no vertex,
// and the crossings of a closed oriented mesh add up to the winding number of p.

int ray_crossing_exact(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

// 0 if the ray from p misses the triangle abc; else +1 if it leaves through the side the normal points to
// (normal.x > 0), -1 if it enters. Triangles parallel to x are never crossed. \pre p is not on the closed
// triangle.
inline int ray_crossing(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  if (p.x > a.x && p.x > b.x && p.x > c.x) return 0;
  if ((p.y < a.y && p.y < b.y && p.y < c.y) || (p.y >= a.y && p.y >= b.y && p.y >= c.y)) return 0;
  if ((p.z < a.z && p.z < b.z && p.z < c.z) || (p.z >= a.z && p.z >= b.z && p.z >= c.z)) return 0;
  return ray_crossing_exact(p, a, b, c);
}

// For p a vertex of a closed mesh whose star is the fan (p, link[i], link[i + 1 mod n]), oriented outward,
// that does not intersect itself: on which side of the star does the ray from p run once it has passed the
// star's topmost sheet over p + (0, eps, eps^2)?
//   +1 outside: that sheet's outward normal has positive x.
//   -1 inside: it has negative x.
//    0: the star has no sheet there.
// With the star's own triangles left out, the crossings of the rest of the mesh add up to the winding number
// of the points p + (t, eps, eps^2), t small but large against eps.
int ray_leaves_star(const Vec3& p, const Vec3* link, u32 n);

// On which side of the star these points are where triangles of it hold the direction +x, as on the side of a box: one
// that goes through, or two with an edge along it. 0 where none does.
int side_beside_sheet(const Vec3& p, const Vec3* link, u32 n);

// The same where neither of these tells. Then a half plane that turns about the line through p along x, from (1, eps)
// in the yz plane on, goes through that side until it touches the star, in edges to corners of the link. The link is on
// one side of it there, so where it turns at such a corner, its turn tells. A corner behind p on that line, which all
// half planes touch, does where no corner is touched within half a turn. 0 only where the star meets itself.
int side_beside_corner(const Vec3& p, const Vec3* link, u32 n);

// Cheap proof that no two triangles of p's fan meet except in what they share: seen along the sum of the
// fan's normals, all turn the same way and go round p once. False means "not proven". Never proven for n < 3
// or n > 32. Writes behind the corners, where there is room for star_room in all.
inline constexpr u32 star_is_unfolded_limit = 32, star_room = star_is_unfolded_limit + 1;
bool star_is_unfolded(const Vec3& p, Vec3* link, u32 n);

}  // namespace tpa
