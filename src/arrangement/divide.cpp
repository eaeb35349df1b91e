// SPDX-License-Identifier: MIT
#include "arrangement/divide.h"

#include "arrangement/pieces_wanted.h"
#include "arrangement/traces.h"
#include "geometry/predicates.h"

namespace tpa {

namespace {

enum : u32 { front, behind };

// The faces and traces of a plane.
struct Facet {
  Span<const u32> places;  // in Arrangement::faces
  Span<const u32> traces;
};

// ---------------------------------------------------------------- the map

bool enter(Arrangement& a, u32 point) {
  u32& place = a.place[point];
  if (place != none) return true;
  place = a.map.vertex.size;
  return a.map.vertex.push(point);
}

bool make_map(Arrangement& a, const Facet& facet) {
  PlanarMap& m = a.map;
  m.points = &a.points;
  m.plane = plane_of_face(a.faces[facet.places[0]]);
  m.axis = axis_of(*a.mesh, m.plane.id);
  m.vertex.clear();
  m.work.clear();
  bool fits = true;
  for (u32 number : facet.traces) fits = fits && enter(a, a.traces[number].p) && enter(a, a.traces[number].q);
  if (fits) {
    triangulate(m);
    if (has_stopped(a)) return false;
    for (u32 i = 0; i < m.vertex.size; ++i) a.place[m.vertex[i]] = i;
    make_even(m);
    for (u32 number : facet.traces) {
      const Trace& t = a.traces[number];
      fits = fits && keep_segment(m, a.place[t.p], a.place[t.q], number, a.traces.span());
    }
    make_even(m);
  }
  return fits;
}

void leave(Arrangement& a, const Facet& facet) {
  for (u32 number : facet.traces) a.place[a.traces[number].p] = a.place[a.traces[number].q] = none;
}

// ---------------------------------------------------------------- cover

// A face in the map, counter-clockwise.
struct FacePlaces {
  u32 at[3];
};
FacePlaces corners_of(Arrangement& a, u32 f, bool seen_from_front) {
  const u32* c = a.mesh->corner + 3 * static_cast<size_t>(f);
  FacePlaces out;
  for (u32 i = 0; i < 3; ++i) out.at[i] = a.place[add_vertex_point(a.points, c[seen_from_front ? i : 2 - i])];
  return out;
}

// Does the kept edge h lie on a side of the face?
bool is_on_rim(const PlanarMap& m, const FacePlaces& c, u32 h) {
  for (u32 i = 0; i < 3; ++i) {
    const u32 p = c.at[i], q = c.at[(i + 1) % 3];
    if (turn(m, p, q, m.corner[h]) == 0 && turn(m, p, q, m.corner[next_edge(h)]) == 0) return true;
  }
  return false;
}

void cover(Arrangement& a, u32 triangle, u32 side, u32 f) {
  ++a.cover[side][triangle];
  a.origin[side][triangle] = min_of(a.origin[side][triangle], f);
}

// Adds a face to the cover of its triangles: those reached from a corner without crossing a side.
bool cover_by_face(Arrangement& a, u32 f) {
  PlanarMap& m = a.map;
  const u32* v = a.mesh->corner + 3 * static_cast<size_t>(f);
  const Vec3* p = a.mesh->position;
  const bool seen_from_front = flat_orient(static_cast<int>(m.axis), p[v[0]], p[v[1]], p[v[2]]) > 0;
  const FacePlaces c = corners_of(a, f, seen_from_front);
  const u32 start = edge_towards(m, c.at[0], c.at[1]);
  if (start == none) {
    m.contradiction = true;
    return false;
  }
  Stack<u32>& reached = m.work;
  reached.clear();
  const auto reach = [&](u32 t) {
    if (m.mark[t] != 0) return;
    m.mark[t] = 1;
    reached.push(t);
    cover(a, t, seen_from_front ? front : behind, f);
  };
  reach(face_of(start));
  for (u32 i = 0; i < reached.size && !has_stopped(a); ++i)
    for (u32 h = 3 * reached[i]; h < 3 * reached[i] + 3; ++h)
      if (m.opposite[h] != none && (m.trace[h] == none || !is_on_rim(m, c, h))) reach(face_of(m.opposite[h]));
  for (u32 t : reached) m.mark[t] = 0;
  spend(meter_of(a), reached.size);
  return !has_stopped(a);
}

bool find_cover(Arrangement& a, const Facet& facet) {
  spend(meter_of(a), triangle_count(a.map));
  for (u32 t = 0; t < triangle_count(a.map); ++t)
    for (u32 side = front; side <= behind; ++side) {
      a.cover[side][t] = 0;
      a.origin[side][t] = none;
    }
  for (u32 place : facet.places)
    if (!cover_by_face(a, a.faces[place])) return false;
  return true;
}

// ---------------------------------------------------------------- pieces

bool add_pieces(Arrangement& a, u32 name) {
  const PlanarMap& m = a.map;
  for (u32 t = 0; t < triangle_count(m); ++t) {
    const i32 layers = a.cover[front][t] - a.cover[behind][t];
    if (layers == 0) continue;
    const u32 x = m.vertex[m.corner[3 * t]], y = m.vertex[m.corner[3 * t + 1]], z = m.vertex[m.corner[3 * t + 2]];
    const CutPiece piece = layers > 0 ? CutPiece{{x, y, z}, a.origin[front][t], name, layers, 0}
                                      : CutPiece{{x, z, y}, a.origin[behind][t], name, -layers, 0};
    if (!a.pieces.push(piece)) return false;
  }
  return true;
}

}  // namespace

bool divide_facets(Arrangement& a) {
  a.pieces.clear();
  for (u32 i = 0; i < a.points.list.size; ++i) a.place[i] = none;  // all ends of traces
  bool counts = is_crowded(a);
  for (u32 first = 0; first < a.faces.size;) {
    const u32 name = a.facet[a.facet_faces[first]];
    u32 end = first + 1;
    while (end < a.faces.size && a.facet[a.facet_faces[end]] == name) ++end;
    const u32 from = a.first_trace[name], to = a.first_trace[name + 1];
    const Facet facet{{a.facet_faces + first, end - first}, {a.facet_traces + from, to - from}};
    const bool fits = make_map(a, facet) && find_cover(a, facet) && add_pieces(a, name);
    leave(a, facet);
    if (!fits) return false;
    if (counts && a.pieces.size > a.pieces.capacity / counting_share) {
      counts = false;
      const u64 refused = refusal_share * a.pieces.capacity;
      a.wanted = most_pieces(a, refused);
      if (has_stopped(a) || a.wanted > refused) return false;
    }
    first = end;
  }
  return true;
}

}  // namespace tpa
