// SPDX-License-Identifier: MIT
#include "arrangement/planar_map.h"

#include "base/sort.h"

namespace tpa {

namespace {

void set_hull(PlanarMap& m, u32 from, u32 to, u32 half_edge) {
  m.after[from] = to;
  m.before[to] = from;
  m.leaving[from] = half_edge;
}

// Triangles from p to a chain of collinear vertices, with p on the left. at(i) is vertex i of the chain.
template <class At>
void make_first_fan(PlanarMap& m, u32 p, u32 count, At at) {
  for (u32 i = 0; i + 1 < count; ++i) {
    const u32 h = add_triangle(m, at(i), at(i + 1), p);
    set_hull(m, at(i), at(i + 1), h);
    if (i > 0) link(m, h - 2, h + 2);
  }
  set_hull(m, at(count - 1), p, m.corner.size - 2);
  set_hull(m, p, at(0), 2);
}

// Joins p, beyond all vertices before it, to the hull's edges in sight. `last` is the vertex before.
void join_to_hull(PlanarMap& m, u32 p, u32 last) {
  u32 first = last, end = last;  // the chain of hull vertices in sight
  while (turn(m, end, m.after[end], p) < 0) end = m.after[end];
  while (turn(m, m.before[first], first, p) < 0) first = m.before[first];
  u32 beside = none;  // the half-edge to p of the triangle before
  for (u32 v = first; v != end;) {
    const u32 w = m.after[v], h = add_triangle(m, w, v, p);
    link(m, h, m.leaving[v]);
    if (beside == none)
      set_hull(m, first, p, h + 1);
    else
      link(m, h + 1, beside);
    beside = h + 2;
    v = w;
  }
  set_hull(m, p, end, beside);
}

void sort_vertices(PlanarMap& m) {
  const ArrangementPoints& a = *m.points;
  spend(a.meter, sorting_steps(m.vertex.size));
  const u32 u = (m.axis + 1) % 3, v = (m.axis + 2) % 3;
  sort_in_place(m.vertex.data, m.vertex.size, [&](u32 p, u32 q) {
    const int order = compare_along(a, u, p, q);
    return order != 0 ? order < 0 : compare_along(a, v, p, q) < 0;
  });
}

// ---------------------------------------------------------------- flips

const Vec3& position(const PlanarMap& m, u32 v) { return m.points->list[m.vertex[v]].at; }

// The cotangent of the angle at `at`.
f64 cotangent(const Vec3& at, const Vec3& a, const Vec3& b) {
  const f64 area = length(cross(a - at, b - at));
  return area > 0 ? dot(a - at, b - at) / area : 0x1p60;
}

struct Border {
  u32 beyond, trace;
};
Border border_of(const PlanarMap& m, u32 h) { return {m.opposite[h], m.trace[h]}; }
void set_border(PlanarMap& m, u32 h, const Border& b) {
  link(m, h, b.beyond);
  m.trace[h] = b.trace;
}

// Triangles (a, b, c) and (b, a, d) become (d, b, c) and (c, a, d).
void flip(PlanarMap& m, u32 h) {
  const u32 g = m.opposite[h], t = 3 * face_of(h), s = 3 * face_of(g);
  const u32 a = m.corner[h], b = m.corner[g], c = m.corner[previous_edge(h)], d = m.corner[previous_edge(g)];
  const Border bc = border_of(m, next_edge(h)), ca = border_of(m, previous_edge(h));
  const Border ad = border_of(m, next_edge(g)), db = border_of(m, previous_edge(g));
  const u32 corners[2][3] = {{d, b, c}, {c, a, d}};
  for (u32 i = 0; i < 3; ++i) m.corner[t + i] = corners[0][i], m.corner[s + i] = corners[1][i];
  set_border(m, t, db);
  set_border(m, t + 1, bc);
  set_border(m, s, ca);
  set_border(m, s + 1, ad);
  link(m, t + 2, s + 2);
  m.trace[t + 2] = m.trace[s + 2] = none;
  note_leaving(m, t / 3);
  note_leaving(m, s / 3);
}

// By how much the sum of the opposite angles' cotangents must be negative: beyond rounding errors.
constexpr f64 clearly_uneven = -0x1p-20;
constexpr u32 most_flip_sweeps = 64;

bool is_uneven(const PlanarMap& m, u32 h) {
  const u32 g = m.opposite[h];
  if (g == none || g < h || m.trace[h] != none) return false;
  const u32 a = m.corner[h], b = m.corner[g], c = m.corner[previous_edge(h)], d = m.corner[previous_edge(g)];
  const Vec3 &pa = position(m, a), &pb = position(m, b);
  if (!(cotangent(position(m, c), pa, pb) + cotangent(position(m, d), pa, pb) < clearly_uneven)) return false;
  return turn(m, d, b, c) > 0 && turn(m, c, a, d) > 0;
}

}  // namespace

u32 add_triangle(PlanarMap& m, u32 a, u32 b, u32 c) {
  const u32 h = m.corner.size;
  m.corner.push(a);
  m.corner.push(b);
  m.corner.push(c);
  for (u32 i = h; i < h + 3; ++i) m.opposite[i] = m.trace[i] = none;
  m.mark[face_of(h)] = 0;
  return h;
}

void note_leaving(PlanarMap& m, u32 t) {
  for (u32 h = 3 * t; h < 3 * t + 3; ++h) {
    const u32 v = m.corner[h];
    if (m.corner[m.leaving[v]] != v || m.opposite[h] == none) m.leaving[v] = h;
  }
}

void triangulate(PlanarMap& m) {
  sort_vertices(m);
  m.corner.clear();
  u32 chain = 2;
  while (turn(m, 0, 1, chain) == 0) ++chain;
  if (turn(m, 0, 1, chain) > 0)
    make_first_fan(m, chain, chain, [](u32 i) { return i; });
  else
    make_first_fan(m, chain, chain, [&](u32 i) { return chain - 1 - i; });
  for (u32 p = chain + 1; p < m.vertex.size && !has_stopped(m.points->meter); ++p) join_to_hull(m, p, p - 1);
}

void make_even(PlanarMap& m) {
  for (u32 sweep = 0, flips = 1; flips > 0 && sweep < most_flip_sweeps; ++sweep) {
    flips = 0;
    spend(m.points->meter, m.corner.size);
    if (has_stopped(m.points->meter)) return;
    for (u32 h = 0; h < m.corner.size; ++h)
      if (is_uneven(m, h)) {
        flip(m, h);
        ++flips;
      }
  }
}

}  // namespace tpa
