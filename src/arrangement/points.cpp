// SPDX-License-Identifier: MIT
#include "arrangement/points.h"

#include "arrangement/known_lines.h"

namespace tpa {

namespace {

// Units of work: a question about points; an exact answer where the filter has none; a point made exactly.
constexpr u64 of_question = 1, of_exact_answer = 60, of_exact_point = 40;

u32 hash_of(const Vec3& p) {
  u64 bits[3];
  const f64 plus_zero[3] = {p.x + 0.0, p.y + 0.0, p.z + 0.0};  // -0 and 0 are one coordinate
  memcpy(bits, plus_zero, sizeof bits);
  u64 mixed = 0;
  for (u64 b : bits) mixed = (mixed ^ b ^ b >> 29) * scattering;
  return static_cast<u32>(mixed >> 32);
}

ExactPoint exact_point(const Mesh& m, const ArrangementPoint& p) {
  if (p.exact == all_exact) return exact_point(p.at);
  const auto plane = [&](u32 i) { return exact_plane(m, {p.id[i], p.axis[i]}); };
  switch (p.kind) {
    case PointKind::vertex: return exact_point(p.at);
    case PointKind::edge_crossing:
      return line_through_plane(m.position[tail(m, p.id[0])], m.position[head(m, p.id[0])], plane(1));
    case PointKind::plane_crossing: return common_point(plane(0), plane(1), plane(2));
  }
  return exact_point(p.at);
}

NearPlane near_plane(const Mesh& m, PlaneRef plane) {
  if (plane.axis != of_face)
    return near_plane_along(m.position[tail(m, plane.id)], m.position[head(m, plane.id)], plane.axis);
  const u32* c = m.corner + 3 * static_cast<size_t>(plane.id);
  return near_plane(m.position[c[0]], m.position[c[1]], m.position[c[2]]);
}

NearPoint near_point(const Mesh& m, const ArrangementPoint& p) {
  if (p.exact == all_exact) return near_point(p.at);
  const auto plane = [&](u32 i) { return near_plane(m, {p.id[i], p.axis[i]}); };
  if (p.kind == PointKind::plane_crossing) return near_common_point(plane(0), plane(1), plane(2));
  return near_line_through_plane(m.position[tail(m, p.id[0])], m.position[head(m, p.id[0])], plane(1));
}

void round_coordinates(const Mesh& m, ArrangementPoint& p) {
  u32 exact = 0;
  if (!round_nearly(near_point(m, p), p.at, exact)) p.at = rounded(exact_point(m, p), exact);
  p.exact = static_cast<u8>(exact & all_exact);
}

// Points with equal coordinates after rounding differ in rare cases.
bool are_equal(const ArrangementPoints& a, const ArrangementPoint& p, const ArrangementPoint& q) {
  if (!(p.at == q.at) || p.exact != q.exact) return false;
  if (p.exact == all_exact) return true;
  spend(a.meter, of_exact_answer);
  const NearPoint near_p = near_point(*a.mesh, p), near_q = near_point(*a.mesh, q);
  for (u32 axis = 0; axis < 3; ++axis)
    if (const int order = near_compare_along(axis, near_p, near_q); order == 1 || order == -1) return false;
  return equal(exact_point(*a.mesh, p), exact_point(*a.mesh, q));
}

u32 add(ArrangementPoints& a, const ArrangementPoint& p) {
  spend(a.meter, of_question);
  u32& slot = a.by_position.find(hash_of(p.at), [&](u32 i) { return are_equal(a, a.list[i], p); });
  if (slot != none) return slot;
  const u32 number = a.list.size;
  if (!a.list.push(p)) return none;
  return slot = number;
}

bool is_on_two_edges(const ArrangementPoint& p) { return p.kind == PointKind::edge_crossing && p.id[2] != none; }

bool have_same_origin(const ArrangementPoint& p, const ArrangementPoint& q) {
  if (p.kind != q.kind) return false;
  if (is_on_two_edges(p))
    return (p.id[0] == q.id[0] && p.id[2] == q.id[2]) || (p.id[0] == q.id[2] && p.id[2] == q.id[0]);
  bool same = true;
  for (u32 i = 0; i < 3; ++i) same = same && p.id[i] == q.id[i] && p.axis[i] == q.axis[i];
  return same;
}

u32 hash_of_origin(const ArrangementPoint& p) {
  if (is_on_two_edges(p)) return scattered(min_of(p.id[0], p.id[2]), max_of(p.id[0], p.id[2]));
  return scattered(scattered(p.id[0], p.id[1]), p.id[2] ^ p.axis[1]);
}

void set_slots(ArrangementPoints& a, u32 points) {
  a.by_position.size = a.by_origin.size = point_hash_slots(min_of(points, a.list.capacity));
  a.by_position.clear();
  a.by_origin.clear();
}

// For one more point.
void make_room(ArrangementPoints& a) {
  if (point_hash_slots(a.list.size + 1) <= a.by_position.size || a.list.size == a.list.capacity) return;
  spend(a.meter, 4 * u64{a.list.size});
  set_slots(a, 4 * a.list.size);
  const auto never = [](u32) { return false; };
  for (u32 i = 0; i < a.list.size; ++i) {
    a.by_position.find(hash_of(a.list[i].at), never) = i;
    if (a.list[i].kind != PointKind::vertex) a.by_origin.find(hash_of_origin(a.list[i]), never) = i;
  }
}

// The same point is asked for by each face, or each plane, that holds it: its coordinates are computed once.
u32 add_constructed(ArrangementPoints& a, ArrangementPoint& p) {
  make_room(a);
  u32& slot = a.by_origin.find(hash_of_origin(p), [&](u32 i) { return have_same_origin(a.list[i], p); });
  spend(a.meter, slot != none ? of_question : of_exact_point);
  if (slot != none) return slot;
  round_coordinates(*a.mesh, p);
  const u32 before = a.list.size, number = add(a, p);
  if (number == before) slot = number;
  return number;
}

constexpr int axis_after(u32 axis) { return axis == 2 ? 0 : static_cast<int>(axis) + 1; }

// Are all coordinates of these bits exact in both points?
bool are_exact(u32 bits, const ArrangementPoint& x, const ArrangementPoint& y) {
  return (bits & x.exact & y.exact) == bits;
}
// The coordinates that a turn about the axis asks for.
constexpr u32 bits_across(u32 axis) { return all_exact ^ 1u << axis; }

// The filter of a turn. A rounded coordinate is off by 2^-53 of its magnitude, or by 2^-100 where it became zero; so a
// difference of two is off by 2^-52 of the greater magnitude m, and by its own rounding, 2^-53 of at most 2 m.
int filtered_turn(int u, int v, const Vec3& p, const Vec3& q, const Vec3& r) {
  const f64 largest_u = max_of(abs_of(p[u]), max_of(abs_of(q[u]), abs_of(r[u])));
  const f64 largest_v = max_of(abs_of(p[v]), max_of(abs_of(q[v]), abs_of(r[v])));
  const f64 doubt_u = 0x1p-51 * largest_u + 0x1p-98, doubt_v = 0x1p-51 * largest_v + 0x1p-98;
  const f64 qu = q[u] - p[u], qv = q[v] - p[v], ru = r[u] - p[u], rv = r[v] - p[v];
  const f64 left = qu * rv, right = qv * ru;
  const f64 doubt = (abs_of(qu) + abs_of(ru) + doubt_u) * doubt_v + (abs_of(qv) + abs_of(rv)) * doubt_u +
                    0x1p-52 * (abs_of(left) + abs_of(right));
  // Each factor of `doubt` has a few roundings of its own.
  return filtered_sign(left - right, 1.0001 * doubt);
}

}  // namespace

u32 add_vertex_point(ArrangementPoints& a, u32 v) {
  make_room(a);
  const ArrangementPoint p{a.mesh->position[v], {v, none, none}, {}, PointKind::vertex, all_exact};
  return add(a, p);
}
u32 add_edge_crossing(ArrangementPoints& a, u32 half_edge, PlaneRef plane, u32 met) {
  const auto edge = [&](u32 h) { return min_of(h, a.mesh->opposite[h]); };
  ArrangementPoint p{{},
                     {edge(half_edge), plane.id, met != none ? edge(met) : none},
                     {0, static_cast<u8>(plane.axis), 0},
                     PointKind::edge_crossing,
                     0};
  return add_constructed(a, p);
}
u32 add_plane_crossing(ArrangementPoints& a, PlaneRef p, PlaneRef q, PlaneRef r) {
  const auto comes_first = [](const PlaneRef& x, const PlaneRef& y) {
    return x.id != y.id ? x.id < y.id : x.axis < y.axis;
  };
  if (comes_first(q, p)) swap_values(p, q);
  if (comes_first(r, q)) swap_values(q, r);
  if (comes_first(q, p)) swap_values(p, q);
  ArrangementPoint point{{},
                         {p.id, q.id, r.id},
                         {static_cast<u8>(p.axis), static_cast<u8>(q.axis), static_cast<u8>(r.axis)},
                         PointKind::plane_crossing,
                         0};
  return add_constructed(a, point);
}

void clear(ArrangementPoints& a) {
  constexpr u32 first_points = 1024;
  a.list.clear();
  set_slots(a, first_points);
}

ExactPlane exact_plane(const Mesh& m, PlaneRef plane) {
  if (plane.axis != of_face)
    return exact_plane_along(m.position[tail(m, plane.id)], m.position[head(m, plane.id)], plane.axis);
  const u32* c = m.corner + 3 * static_cast<size_t>(plane.id);
  return exact_plane(m.position[c[0]], m.position[c[1]], m.position[c[2]]);
}

NormalOf<Vec3> rounded_normal(const Mesh& m, PlaneRef plane) {
  if (plane.axis == of_face) {
    const u32* c = m.corner + 3 * static_cast<size_t>(plane.id);
    return normal_of(m.position[c[1]] - m.position[c[0]], m.position[c[2]] - m.position[c[0]]);
  }
  const Vec3 way = m.position[head(m, plane.id)] - m.position[tail(m, plane.id)];
  const int j = axis_after(plane.axis), k = axis_after(static_cast<u32>(j));
  NormalOf<Vec3> out{};
  out.normal[j] = way[k], out.normal[k] = -way[j];
  out.magnitude[j] = abs_of(way[k]), out.magnitude[k] = abs_of(way[j]);
  return out;
}

// A product of two components is off by at most some 8 * 2^-53 of the product of their magnitudes.
int filtered_cross(u32 axis, const NormalOf<Vec3>& a, const NormalOf<Vec3>& b) {
  const int j = axis_after(axis), k = axis_after(static_cast<u32>(j));
  const f64 size = a.magnitude[j] * b.magnitude[k] + a.magnitude[k] * b.magnitude[j];
  return filtered_sign(a.normal[j] * b.normal[k] - a.normal[k] * b.normal[j], 16 * 0x1p-53 * size);
}

int filtered_dot(const NormalOf<Vec3>& a, const NormalOf<Vec3>& b) {
  return filtered_sign(dot(a.normal, b.normal), 16 * 0x1p-53 * dot(a.magnitude, b.magnitude));
}

ExactPoint exact_point(const ArrangementPoints& a, u32 p) { return exact_point(*a.mesh, a.list[p]); }

int compare_along(const ArrangementPoints& a, u32 axis, u32 p, u32 q) {
  const int i = static_cast<int>(axis);
  // Rounding keeps the order.
  const int order = compare(a.list[p].at[i], a.list[q].at[i]);
  if (order != 0 || p == q || are_exact(1u << axis, a.list[p], a.list[q])) return order;
  spend(a.meter, of_exact_answer);
  const int near = near_compare_along(axis, near_point(*a.mesh, a.list[p]), near_point(*a.mesh, a.list[q]));
  return near != 2 ? near : compare_along(axis, exact_point(a, p), exact_point(a, q));
}

int turn(const ArrangementPoints& a, u32 axis, u32 p, u32 q, u32 r) {
  spend(a.meter, of_question);
  const ArrangementPoint &x = a.list[p], &y = a.list[q], &z = a.list[r];
  if (are_exact(bits_across(axis), x, y) && are_exact(bits_across(axis), y, z))
    return flat_orient(static_cast<int>(axis), x.at, y.at, z.at);
  const int u = axis_after(axis), v = axis_after(static_cast<u32>(u));
  const int sign = filtered_turn(u, v, x.at, y.at, z.at);
  if (sign != 2) return sign;
  if (come_from_line(*a.mesh, x, y, z)) return 0;
  spend(a.meter, of_exact_answer);
  const Mesh& m = *a.mesh;
  const int near = near_flat_orient(axis, near_point(m, x), near_point(m, y), near_point(m, z));
  return near != 2 ? near : flat_orient(axis, exact_point(a, p), exact_point(a, q), exact_point(a, r));
}

int turn(const ArrangementPoints& a, u32 axis, u32 p, u32 q, const Vec3& r) {
  spend(a.meter, of_question);
  const ArrangementPoint &x = a.list[p], &y = a.list[q];
  if (are_exact(bits_across(axis), x, y)) return flat_orient(static_cast<int>(axis), x.at, y.at, r);
  const int u = axis_after(axis), v = axis_after(static_cast<u32>(u));
  const int sign = filtered_turn(u, v, x.at, y.at, r);
  if (sign == 2) spend(a.meter, of_exact_answer);
  return sign != 2 ? sign : flat_orient(axis, exact_point(a, p), exact_point(a, q), exact_point(r));
}

}  // namespace tpa
