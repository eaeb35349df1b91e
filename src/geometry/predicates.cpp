// SPDX-License-Identifier: MIT
// predicates: the exact stages, and the triangle tests built on orientations alone. Triangle tests follow Moeller 1997
// and Guigue & Devillers 2003: planes first, then the order of the crossings on the line common to both planes.
// Degenerate cases go through segment tests that hold for any input.
// Loops are bounded by the sizes of the expansions, 192 terms at most.
#include "geometry/predicates.h"

#include "geometry/expansion.h"
#include "geometry/separating_axes.h"

namespace tpa {

namespace {

// Adds a minor times f to a sum, term by term of f, for little stack. The case f = 0 is frequent in meshes along axes.
using Determinant = Expansion<192>;
void add_minor_times(const Expansion<2>& a, const Expansion<2>& b, const Expansion<2>& c, const Expansion<2>& d,
                     const Expansion<2>& f, Determinant& sum) {
  if (f.size == 0) return;
  const Minor minor = minor_of(a, b, c, d);
  for (u32 i = 0; i < f.size; ++i) {
    const Expansion<32> part = minor * f.term[i];
    f64 before[192 - 32];  // all terms of the determinant but those of this part
    memcpy(before, sum.term, sum.size * sizeof(f64));
    sum.size = add_terms(before, sum.size, part.term, part.size, 1, sum.term);
  }
}

// orient3d() out of line, for callers that seldom need it.
int turn_of(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) { return orient3d(a, b, c, d); }

// Two turns about the same first point: (p, q[i], a[i], b[i]).
struct Turns {
  const Vec3 *q[2], *a[2], *b[2];
};
struct TwoSigns {
  int first, second;
};
TwoSigns signs_of(const Vec3& p, const Turns& t) {
#if defined(TPA_VECTORS)
  const auto both = [](const Vec3* const of[2]) { return two_points(*of[0], *of[1]); };
  const Height<D2> h = heights_above(planes_of(two_points(p, p), both(t.q), both(t.a)), both(t.b));
  const u32 above = bits_of_two(h.value > h.doubt), below = bits_of_two(h.value < -h.doubt);
  const auto sign = [&](u32 i) { return static_cast<int>(above >> i & 1) - static_cast<int>(below >> i & 1); };
  if ((above | below) == 3) return {sign(0), sign(1)};
#endif
  return {turn_of(p, *t.q[0], *t.a[0], *t.b[0]), turn_of(p, *t.q[1], *t.a[1], *t.b[1])};
}

}  // namespace

int orient2d_exact(f64 ax, f64 ay, f64 bx, f64 by, f64 cx, f64 cy) {
  return sign_of(
      minor_of(exact_difference(bx, ax), exact_difference(by, ay), exact_difference(cx, ax), exact_difference(cy, ay)));
}

int orient3d_exact(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const ExactVec3 edge[3] = {exact_vector(b, a), exact_vector(c, a), exact_vector(d, a)};
  // The determinant stays the same under rotation of the rows. The row with the fewest terms (a zero has none) comes
  // last.
  u32 last = 0;
  const auto terms = [&](u32 i) { return edge[i].x.size + edge[i].y.size + edge[i].z.size; };
  for (u32 i = 1; i < 3; ++i)
    if (terms(i) < terms(last)) last = i;
  const ExactVec3 &u = edge[(last + 1) % 3], &v = edge[(last + 2) % 3], &w = edge[last];
  Determinant sum;
  sum.size = 0;
  add_minor_times(u.y, u.z, v.y, v.z, w.x, sum);
  add_minor_times(u.z, u.x, v.z, v.x, w.y, sum);
  add_minor_times(u.x, u.y, v.x, v.y, w.z, sum);
  return sign_of(sum);
}

int flat_orient(int axis, const Vec3& a, const Vec3& b, const Vec3& c) {
  if (axis == 0) return orient2d(a.y, a.z, b.y, b.z, c.y, c.z);
  if (axis == 1) return orient2d(a.z, a.x, b.z, b.x, c.z, c.x);
  return orient2d(a.x, a.y, b.x, b.y, c.x, c.y);
}

namespace {

// Tests in a coordinate plane, without the axis as in flat_orient.

bool spans_overlap(f64 p, f64 q, f64 a, f64 b) { return min_of(p, q) <= max_of(a, b) && min_of(a, b) <= max_of(p, q); }

// If all four orientations are zero, all points are on one line, where overlapping boxes mean meeting. Otherwise the
// lines cross in one point, and both segments reach the point if neither lies strictly on one side of the other's line.
bool flat_segments_meet(int axis, const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i) {
    if (i != axis && !spans_overlap(p[i], q[i], a[i], b[i])) return false;
  }
  if (flat_orient(axis, p, q, a) * flat_orient(axis, p, q, b) > 0) return false;
  return flat_orient(axis, a, b, p) * flat_orient(axis, a, b, q) <= 0;
}

bool flat_strictly_inside(int axis, const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int side = flat_orient(axis, a, b, p);
  return side != 0 && side == flat_orient(axis, b, c, p) && side == flat_orient(axis, c, a, p);
}

bool flat_segment_meets_triangle(int axis, const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  return flat_segments_meet(axis, p, q, a, b) || flat_segments_meet(axis, p, q, b, c) ||
         flat_segments_meet(axis, p, q, c, a) || flat_strictly_inside(axis, p, a, b, c);
}

bool flat_triangles_meet(int axis, const Triangle& a, const Triangle& b) {
  for (u32 i = 0; i < 3; ++i) {
    if (flat_segment_meets_triangle(axis, a[i], a[(i + 1) % 3], b[0], b[1], b[2])) return true;
  }
  return flat_strictly_inside(axis, b[0], a[0], a[1], a[2]);
}

// At least one of the three projections is one to one on the plane of all points, or on their line if several planes
// hold them. Meeting there is meeting in space, and meeting in space shows in all three projections. So "in all three"
// is exact, and a projection in which the triangle keeps an area decides alone.
bool coplanar_segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!flat_segment_meets_triangle(axis, p, q, a, b, c)) return false;
    if (flat_orient(axis, a, b, c) != 0) return true;
  }
  return true;
}

// Edges suffice: two closed triangles meet in a point, a segment or a polygon with a corner on some edge.
bool some_edge_meets(const Triangle& a, const Triangle& b) {
  for (u32 i = 0; i < 3; ++i) {
    const u32 j = (i + 1) % 3;
    if (segment_meets_triangle(a[i], a[j], b[0], b[1], b[2])) return true;
    if (segment_meets_triangle(b[i], b[j], a[0], a[1], a[2])) return true;
  }
  return false;
}

// \pre Every corner's side of the other's plane is zero.
bool triangles_meet_in_plane(const Triangle& a, const Triangle& b) {
  for (int axis = 0; axis < 3; ++axis) {
    if (flat_orient(axis, a[0], a[1], a[2]) != 0 || flat_orient(axis, b[0], b[1], b[2]) != 0) {
      return flat_triangles_meet(axis, a, b);
    }
  }
  return some_edge_meets(a, b);  // both degenerate, possibly skew
}

// Guigue & Devillers 2003: let a0 and b0 be alone on their sides of the other plane, and each on the positive side. The
// edges from a0 and b0 cut two intervals out of the line common to both planes, and two orientations tell that neither
// interval ends before the other begins. \pre No corner lies in the other plane, and no triangle lies on one side of
// it; bits are set for the corners above.
bool crossing_intervals_overlap(const Triangle& a, const Triangle& b, u32 a_above, u32 b_above) {
  const bool a_lone_above = (a_above & (a_above - 1)) == 0, b_lone_above = (b_above & (b_above - 1)) == 0;
  const u32 i = (a_lone_above ? a_above : 7 ^ a_above) >> 1, j = (b_lone_above ? b_above : 7 ^ b_above) >> 1;
  const u32 a_turn = b_lone_above ? 1 : 2, b_turn = a_lone_above ? 1 : 2;
  const Vec3 &a0 = a[i], &a1 = a[(i + a_turn) % 3], &a2 = a[(i + 3 - a_turn) % 3];
  const Vec3 &b0 = b[j], &b1 = b[(j + b_turn) % 3], &b2 = b[(j + 3 - b_turn) % 3];
  const TwoSigns turns = signs_of(a0, {{&a1, &a2}, {&b0, &b0}, {&b1, &b2}});
  return turns.first <= 0 && turns.second >= 0;
}

}  // namespace

bool segment_meets_triangle(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int p_side = turn_of(a, b, c, p), q_side = turn_of(a, b, c, q);
  if (p_side * q_side > 0) return false;
  const int ab = turn_of(p, q, a, b), bc = turn_of(p, q, b, c), ca = turn_of(p, q, c, a);
  if (p_side == 0 && q_side == 0) {
    // pq is in the plane of abc, or abc is degenerate and spans no plane: then the edges must be coplanar with pq.
    return ab == 0 && bc == 0 && ca == 0 && coplanar_segment_meets_triangle(p, q, a, b, c);
  }
  return min_of(ab, min_of(bc, ca)) >= 0 || max_of(ab, max_of(bc, ca)) <= 0;
}

namespace {

bool on_one_side(const CertainSides& s) { return (s.above == 7) | (s.below == 7); }
bool all_certain(const CertainSides& s) { return (s.above | s.below) == 7; }

bool have_common_corner(const Triangle& a, const Triangle& b) {
  for (u32 i = 0; i < 3; ++i)
    if (a[i] == b[0] || a[i] == b[1] || a[i] == b[2]) return true;
  return false;
}

// For a corner that the filter leaves open, or a corner in the other plane.
bool triangles_meet_in_doubt(const Triangle& a, const Triangle& b) {
  if (have_common_corner(a, b)) return true;
  const Plane a_plane = plane_of(a[0], a[1], a[2]), b_plane = plane_of(b[0], b[1], b[2]);
  int a_side[3], b_side[3];
  bool open = false;
  for (u32 i = 0; i < 3; ++i) {
    a_side[i] = filtered_side(b_plane, a[i]), b_side[i] = filtered_side(a_plane, b[i]);
    open |= (a_side[i] == 2) | (b_side[i] == 2);
  }
  if (open && provably_apart(a, b)) return false;
  CertainSides of_a{}, of_b{};
  for (u32 i = 0; i < 3; ++i) {
    note_side(of_a, i, decided(b_plane, a[i], a_side[i]));
    note_side(of_b, i, decided(a_plane, b[i], b_side[i]));
  }
  if (on_one_side(of_a) || on_one_side(of_b)) return false;
  if (all_certain(of_a) && all_certain(of_b)) return crossing_intervals_overlap(a, b, of_a.above, of_b.above);
  const bool in_plane = (of_a.above | of_a.below | of_b.above | of_b.below) == 0;
  return in_plane ? triangles_meet_in_plane(a, b) : some_edge_meets(a, b);
}

}  // namespace

FacingSides facing_sides(const Triangle& a, const Triangle& b) {
#if defined(TPA_VECTORS)
  const TwoPlanes planes = planes_of(two_points(a[0], b[0]), two_points(a[1], b[1]), two_points(a[2], b[2]));
  FacingSides s{};
  for (u32 i = 0; i < 3; ++i) {
    const Height<D2> h = heights_above(planes, two_points(b[i], a[i]));
    const u32 above = bits_of_two(h.value > h.doubt), below = bits_of_two(h.value < -h.doubt);
    s.of_b.above |= (above & 1) << i, s.of_b.below |= (below & 1) << i;
    s.of_a.above |= above >> 1 << i, s.of_a.below |= below >> 1 << i;
  }
  return s;
#else
  return {certain_sides(plane_of(a[0], a[1], a[2]), b[0], b[1], b[2]),
          certain_sides(plane_of(b[0], b[1], b[2]), a[0], a[1], a[2])};
#endif
}

bool triangles_meet(const Triangle& a, const Triangle& b) {
  const FacingSides s = facing_sides(a, b);
  if (on_one_side(s.of_b) || on_one_side(s.of_a)) return false;
  if (!all_certain(s.of_a) || !all_certain(s.of_b)) return triangles_meet_in_doubt(a, b);
  return crossing_intervals_overlap(a, b, s.of_a.above, s.of_b.above);
}

namespace {

// For a corner that the filter leaves open, or a corner in the other plane.
bool meet_beyond_vertex_in_doubt(const Vec3& v, const Vec3& a1, const Vec3& a2, const Vec3& b1, const Vec3& b2,
                                 bool b_certain) {
  if (!b_certain && provably_apart_beyond_vertex(v, a1, a2, b1, b2)) return false;
  const int b1_side = turn_of(v, a1, a2, b1), b2_side = turn_of(v, a1, a2, b2);
  if (b1_side * b2_side > 0) return false;
  const int a1_side = turn_of(v, b1, b2, a1), a2_side = turn_of(v, b1, b2, a2);
  if (a1_side * a2_side > 0) return false;
  if (b1_side * b2_side != 0 && a1_side * a2_side != 0) {
    const int edges = turn_of(a1, a2, b1, b2);
    return edges == 0 || edges == a1_side || edges == b1_side;
  }
  const bool a_flat = b1_side == 0 && b2_side == 0 && segment_meets_triangle(v, v, a1, a2, a2);
  const bool b_flat = a1_side == 0 && a2_side == 0 && segment_meets_triangle(v, v, b1, b2, b2);
  if (!a_flat && segment_meets_triangle(a1, a2, v, b1, b2)) return true;
  if (!b_flat && segment_meets_triangle(b1, b2, v, a1, a2)) return true;
  if (!a_flat && !b_flat) return false;
  return (!(a1 == v) && segment_meets_triangle(a1, a1, v, b1, b2)) ||
         (!(a2 == v) && segment_meets_triangle(a2, a2, v, b1, b2)) ||
         (!(b1 == v) && segment_meets_triangle(b1, b1, v, a1, a2)) ||
         (!(b2 == v) && segment_meets_triangle(b2, b2, v, a1, a2));
}

}  // namespace

// Let X be a common point other than v. Both triangles end on the ray from v through X, and the nearer end is common to
// both. A triangle ends on the edge opposite v. In a degenerate triangle v may lie on that edge: then the end is at a
// corner, and the edge says nothing, since the edge meets the other triangle in v anyway.
//
// In general position v lies on the line common to both planes, and each opposite edge cuts the line once. Then b1b2
// meets the first triangle if (a1, a2, b1, b2) turns as (v, a1, b1, b2), the side of a1, and a1a2 meets the second
// triangle if (a1, a2, b1, b2) turns as (v, a1, a2, b1), the side of b1.
bool triangles_meet_beyond_vertex(const Vec3& v, const Vec3& a1, const Vec3& a2, const Vec3& b1, const Vec3& b2) {
  FacingSides s = facing_sides({v, a1, a2}, {v, b1, b2});
  // v lies in both planes, and may count for either side.
  s.of_b.above |= 1, s.of_b.below |= 1, s.of_a.above |= 1, s.of_a.below |= 1;
  if (on_one_side(s.of_b) || on_one_side(s.of_a)) return false;
  if (!all_certain(s.of_b) || !all_certain(s.of_a))
    return meet_beyond_vertex_in_doubt(v, a1, a2, b1, b2, all_certain(s.of_b));
  const int edges = turn_of(a1, a2, b1, b2);
  const int a1_side = s.of_a.above == 3 ? 1 : -1, b1_side = s.of_b.above == 3 ? 1 : -1;
  return edges == 0 || edges == a1_side || edges == b1_side;
}

bool triangles_meet_beyond_edge(const Vec3& u, const Vec3& v, const Vec3& oa, const Vec3& ob) {
  if (provably_apart_beyond_edge(u, v, oa, ob) || turn_of(u, v, oa, ob) != 0) return false;
  if (u == v || oa == u || oa == v || ob == u || ob == v || oa == ob) return true;
  for (int axis = 0; axis < 3; ++axis) {
    const int a_side = flat_orient(axis, u, v, oa), b_side = flat_orient(axis, u, v, ob);
    if (a_side != 0 || b_side != 0) return a_side == b_side;
  }
  // Both triangles are degenerate: on the line uv they must reach beyond the same end of uv.
  const int axis = u.x != v.x ? 0 : u.y != v.y ? 1 : 2;
  const f64 low = min_of(u[axis], v[axis]), high = max_of(u[axis], v[axis]);
  return (oa[axis] < low && ob[axis] < low) || (oa[axis] > high && ob[axis] > high);
}

}  // namespace tpa
