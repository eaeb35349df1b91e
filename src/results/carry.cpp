// SPDX-License-Identifier: MIT
#include "results/carry.h"

#include <string.h>

namespace tpa {

namespace {

template <class Number>
const Number* row_before(const AttributeRows<Number>& a, u32 i) {
  return a.before + static_cast<size_t>(i) * a.width;
}
template <class Number>
Number* row_after(const AttributeRows<Number>& a, u32 i) {
  return a.after + static_cast<size_t>(i) * a.width;
}
template <class Number>
void copy_row(const AttributeRows<Number>& a, const Number* from, Number* to) {
  memcpy(to, from, a.width * sizeof(Number));
}

// Parents of no weight do not count: their attributes may be infinite, or no numbers.
template <class Number>
void take_blend(const AttributeRows<Number>& a, u32 v, const VertexOrigin& o) {
  const Number* p = row_before(a, o.parents[0]);
  Number* to = row_after(a, v);
  if (o.weight == 1 || o.parents[1] == o.parents[0]) return copy_row(a, p, to);
  const Number* q = row_before(a, o.parents[1]);
  if (o.weight == 0) return copy_row(a, q, to);
  const f64 weight = f64{o.weight};
  for (u32 i = 0; i < a.width; ++i) to[i] = static_cast<Number>(weight * f64{p[i]} + (1 - weight) * f64{q[i]});
}

template <class Number>
void blend_all(const Context& c, const AttributeRows<Number>& rows) {
  const VertexOrigin* origins = table_data<VertexOrigin>(c, table_vertex_origin);
  for (u32 v = 0; v < c.vertex_count; ++v) take_blend(rows, v, origins[v]);
}

// ---------------------------------------------------------------- faces without an origin

// Their rows hold notes until all is known, so no other memory is needed: first the number of edges across which the
// nearest face with an origin lies, then the number of this face, with a tag.
constexpr u32 no_note = none, tag = 1u << 31;

struct Followers {
  const Mesh& m;
  const Attributes& rows;

  bool has_origin(u32 f) const { return m.face_origin[f] != none; }
  u32 note(u32 f) const {
    u32 note;
    memcpy(&note, row_after(rows, f), sizeof note);
    return note;
  }
  void set_note(u32 f, u32 note) const { memcpy(row_after(rows, f), &note, sizeof note); }

  // The lowest neighbour at a distance; none if there is none.
  u32 neighbour_at(u32 f, u32 distance) const {
    u32 lowest = none;
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
      const u32 g = face_of(m.opposite[h]);
      const bool fits = distance == 0 ? has_origin(g) : !has_origin(g) && note(g) == distance;
      if (fits) lowest = min_of(lowest, g);
    }
    return lowest;
  }
  template <class Visit>
  void for_each_with(u32 wanted, Visit visit) const {
    for (u32 f = 0; f < m.face_count; ++f)
      if (!has_origin(f) && note(f) == wanted) visit(f);
  }
};

// Returns the greatest distance. Where a component has no origin at all, notes stay as they are.
u32 note_distances(const Followers& all) {
  for (u32 distance = 1;; ++distance) {
    bool any = false;
    all.for_each_with(no_note, [&](u32 f) {
      if (all.neighbour_at(f, distance - 1) == none) return;
      all.set_note(f, distance);
      any = true;
    });
    if (!any) return distance - 1;
  }
}

// The farthest first, so that distances are still noted on the way to an origin.
void note_sources(const Followers& all, u32 greatest) {
  for (u32 distance = greatest; distance > 0; --distance)
    all.for_each_with(distance, [&](u32 f) {
      u32 source = f;
      for (u32 left = distance; left-- > 0;) source = all.neighbour_at(source, left);
      all.set_note(f, tag | source);
    });
}

void follow_neighbours(const Followers& all) {
  const Attributes& rows = all.rows;
  for (u32 f = 0; f < all.m.face_count; ++f)
    if (!all.has_origin(f)) all.set_note(f, no_note);
  note_sources(all, note_distances(all));
  for (u32 f = 0; f < all.m.face_count; ++f) {
    if (all.has_origin(f)) continue;
    const u32 note = all.note(f);
    if (note == no_note)
      memset(row_after(rows, f), 0, rows.width * sizeof(f32));
    else
      copy_row(rows, row_after(rows, note & ~tag), row_after(rows, f));
  }
}

}  // namespace

void carry_vertices(const Context& c, const Attributes& rows) { blend_all(c, rows); }
void carry_vertices(const Context& c, const AttributeRows<f64>& rows) { blend_all(c, rows); }

void carry_triangles(const Context& c, const Attributes& rows) {
  const Mesh m = open_mesh(c);
  const Followers all{m, rows};
  bool missing = false;
  for (u32 f = 0; f < m.face_count; ++f)
    if (all.has_origin(f))
      copy_row(rows, row_before(rows, m.face_origin[f]), row_after(rows, f));
    else
      missing = true;
  if (missing) follow_neighbours(all);
}

}  // namespace tpa
