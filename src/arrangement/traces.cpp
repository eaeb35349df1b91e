// SPDX-License-Identifier: MIT
#include "arrangement/traces.h"

#include "base/disjoint_sets.h"
#include "base/sort.h"
#include "geometry/predicates.h"

namespace tpa {

namespace {

const u32* corners(const Mesh& m, u32 f) { return m.corner + 3 * static_cast<size_t>(f); }

Plane plane_of(const Mesh& m, u32 f) {
  const u32* c = corners(m, f);
  return plane_of(m.position[c[0]], m.position[c[1]], m.position[c[2]]);
}

int face_turn(const Mesh& m, u32 f, u32 axis) {
  const u32* c = corners(m, f);
  return flat_orient(static_cast<int>(axis), m.position[c[0]], m.position[c[1]], m.position[c[2]]);
}

// ---------------------------------------------------------------- faces

bool collect_faces(Arrangement& a, Span<const Contact> contacts) {
  spend(meter_of(a), contacts.size + sorting_steps(2 * contacts.size));
  a.faces.clear();
  // Contacts are sorted by their first face; second faces come in any order and often, so both are sorted and thinned
  // out whenever the list is full.
  const auto thin_out = [&] {
    sort_in_place(a.faces.data, a.faces.size);
    u32 kept = 0;
    for (u32 f : a.faces)
      if ((kept == 0 || a.faces[kept - 1] != f) && axis_of(*a.mesh, f) != of_face) a.faces[kept++] = f;
    a.faces.size = kept;
  };
  const auto add = [&](u32 f) {
    if (a.faces.push(f)) return true;
    thin_out();
    return 2 * u64{a.faces.size} <= a.faces.capacity && a.faces.push(f);
  };
  u32 before = none;
  for (const Contact& c : contacts) {
    if ((c.a != before && !add(c.a)) || !add(c.b)) return false;
    before = c.a;
  }
  thin_out();
  return true;
}

// ---------------------------------------------------------------- traces

// A pair of faces under study. Traces and points appear in both planes.
struct Pair {
  Arrangement& a;
  u32 f, g;              // faces
  u32 f_place, g_place;  // in Arrangement::faces
  u32 found = 0;         // different common points: the ends of what the faces share, no more than two
  u32 point[2] = {none, none};
  bool fits = true;

  void note(u32 p) {
    fits = fits && p != none;
    if (!fits || found == 2 || (found == 1 && point[0] == p)) return;
    point[found++] = p;
  }
  void trace(u32 place, u32 other, u32 p, u32 q) { fits = fits && a.traces.push({place, plane_of_face(other), p, q}); }
};

// Is the point p of the plane of g on the face?
bool holds(const Mesh& m, u32 g, u32 axis, const Vec3& p) {
  const u32* c = corners(m, g);
  int least = 1, most = -1;
  for (u32 i = 0; i < 3; ++i) {
    const int t = flat_orient(static_cast<int>(axis), m.position[c[i]], m.position[c[(i + 1) % 3]], p);
    least = min_of(least, t), most = max_of(most, t);
  }
  return least >= 0 || most <= 0;
}

// The line from p to q, from one side of the plane of g to the other, at the face.
struct Passage {
  bool passes = false;  // through the face
  u32 edge = none;      // the half-edge of g that the line meets between its ends
};
Passage passage_through(const Mesh& m, u32 g, const Vec3& p, const Vec3& q) {
  const u32* c = corners(m, g);
  int least = 1, most = -1;
  u32 met = 0, edge = none;
  for (u32 i = 0; i < 3; ++i) {
    const int t = orient3d(p, q, m.position[c[i]], m.position[c[(i + 1) % 3]]);
    least = min_of(least, t), most = max_of(most, t);
    if (t == 0) ++met, edge = 3 * g + i;
  }
  return {least >= 0 || most <= 0, met == 1 ? edge : none};
}

// Notes the points of f's rim on g. side[i]: the side of corner i of f about the plane of g.
void note_rim(Pair& pair, u32 f, u32 g, const int (&side)[3]) {
  const Mesh& m = *pair.a.mesh;
  const u32* c = corners(m, f);
  for (u32 i = 0; i < 3; ++i) {
    const u32 k = (i + 1) % 3;
    if (side[i] == 0 && holds(m, g, axis_of(m, g), m.position[c[i]])) pair.note(add_vertex_point(pair.a.points, c[i]));
    if (side[i] * side[k] >= 0) continue;
    const Passage at = passage_through(m, g, m.position[c[i]], m.position[c[k]]);
    if (at.passes) pair.note(add_edge_crossing(pair.a.points, 3 * f + i, plane_of_face(g), at.edge));
  }
}

// Turns along an axis: turn[i][k] of edge i of a face and corner k of another face in its plane.
struct EdgeTurns {
  int turn[3][3];
};
// False if a line along an edge keeps the faces apart.
bool find_turns(const Mesh& m, u32 f, u32 g, u32 axis, EdgeTurns& out) {
  const u32 *c = corners(m, f), *d = corners(m, g);
  const int inside = face_turn(m, f, axis);
  for (u32 i = 0; i < 3; ++i) {
    bool apart = true;
    for (u32 k = 0; k < 3; ++k) {
      const Vec3 &p = m.position[c[i]], &q = m.position[c[(i + 1) % 3]];
      out.turn[i][k] = flat_orient(static_cast<int>(axis), p, q, m.position[d[k]]);
      apart = apart && out.turn[i][k] != inside;
    }
    if (apart) return false;
  }
  return true;
}

// Two faces in one plane: the points in which their edges cross. Their corners are points in any case.
void note_flat_crossings(Pair& pair, u32 axis) {
  const Mesh& m = *pair.a.mesh;
  EdgeTurns of_f, of_g;
  if (!find_turns(m, pair.f, pair.g, axis, of_f) || !find_turns(m, pair.g, pair.f, axis, of_g)) return;
  const auto separates = [](const int(&turn)[3], u32 edge) { return turn[edge] * turn[(edge + 1) % 3] < 0; };
  for (u32 i = 0; i < 3; ++i)
    for (u32 k = 0; k < 3; ++k) {
      if (!separates(of_f.turn[i], k) || !separates(of_g.turn[k], i)) continue;
      const u32 point = add_edge_crossing(pair.a.points, 3 * pair.f + i, {3 * pair.g + k, axis}, 3 * pair.g + k);
      pair.fits = pair.fits && point != none;
      if (pair.fits) pair.trace(pair.f_place, pair.g, point, point);
    }
}

bool trace_pair(Arrangement& a, const Contact& c) {
  const Mesh& m = *a.mesh;
  const u32 f_place = place_of_face(a, c.a), g_place = place_of_face(a, c.b);
  if (f_place == none || g_place == none) return true;
  Pair pair{a, c.a, c.b, f_place, g_place};
  int f_side[3], g_side[3];
  const Plane f_plane = plane_of(m, pair.f), g_plane = plane_of(m, pair.g);
  bool flat = true;
  for (u32 i = 0; i < 3; ++i) {
    f_side[i] = side_of(g_plane, m.position[corners(m, pair.f)[i]]);
    flat = flat && f_side[i] == 0;
  }
  if (flat) {
    join_sets(a.facet, f_place, g_place);
    note_flat_crossings(pair, axis_of(m, pair.f));
    return pair.fits;
  }
  for (u32 i = 0; i < 3; ++i) g_side[i] = side_of(f_plane, m.position[corners(m, pair.g)[i]]);
  note_rim(pair, pair.f, pair.g, f_side);
  note_rim(pair, pair.g, pair.f, g_side);
  if (!pair.fits || pair.found == 0) return pair.fits;
  const u32 p = pair.point[0], q = pair.found > 1 ? pair.point[1] : p;
  pair.trace(pair.f_place, pair.g, p, q);
  pair.trace(pair.g_place, pair.f, p, q);
  return pair.fits;
}

// The sides of a face keep it apart from others of its facet.
bool trace_sides(Arrangement& a, u32 place) {
  const u32 f = a.faces[place], axis = axis_of(*a.mesh, a.faces[find_set(a.facet, place)]);
  const u32* c = corners(*a.mesh, f);
  for (u32 i = 0; i < 3; ++i) {
    const u32 p = add_vertex_point(a.points, c[i]), q = add_vertex_point(a.points, c[(i + 1) % 3]);
    if (p == none || q == none || !a.traces.push({place, {3 * f + i, axis}, p, q})) return false;
  }
  return true;
}

// Sorts faces and traces by facet. The facet of name s has the traces first_trace[s] .. first_trace[s + 1] - 1.
void sort_by_facet(Arrangement& a) {
  spend(meter_of(a), sorting_steps(a.faces.size) + 4 * u64{a.traces.size});
  for (u32 i = 0; i < a.faces.size; ++i) a.facet[i] = find_set(a.facet, i);
  for (u32 i = 0; i < a.faces.size; ++i) a.facet_faces[i] = i;
  sort_in_place(a.facet_faces, a.faces.size,
                [&](u32 i, u32 k) { return a.facet[i] != a.facet[k] ? a.facet[i] < a.facet[k] : i < k; });
  const auto facet_of = [&](const Trace& t) { return a.facet[t.place]; };
  for (u32 i = 0; i <= a.faces.size; ++i) a.first_trace[i] = 0;
  for (const Trace& t : a.traces) ++a.first_trace[facet_of(t)];
  u32 sum = 0;
  for (u32 i = 0; i <= a.faces.size; ++i) {
    sum += a.first_trace[i];
    a.first_trace[i] = sum;
  }
  for (u32 i = a.traces.size; i-- > 0;) a.facet_traces[--a.first_trace[facet_of(a.traces[i])]] = i;
}

}  // namespace

u32 axis_of(const Mesh& m, u32 f) {
  const Vec3 n = face_normal(m, f);
  const f64 size[3] = {abs_of(n.x), abs_of(n.y), abs_of(n.z)};
  u32 best = size[1] > size[0] ? 1 : 0;
  best = size[2] > size[best] ? 2 : best;
  for (u32 i = 0; i < 3; ++i)
    if (const u32 axis = (best + i) % 3; face_turn(m, f, axis) != 0) return axis;
  return of_face;
}

bool find_traces(Arrangement& a, Span<const Contact> contacts) {
  clear(a.points);
  a.traces.clear();
  if (!collect_faces(a, contacts)) return false;
  for (u32 i = 0; i < a.faces.size; ++i) a.facet[i] = i;
  // Corners first: where an edge passes through a corner, the corner names the point.
  for (u32 f : a.faces)
    for (u32 i = 0; i < 3; ++i)
      if (add_vertex_point(a.points, corners(*a.mesh, f)[i]) == none) return false;
  constexpr u64 of_pair = 16;  // units of work
  for (const Contact& c : contacts) {
    spend(meter_of(a), of_pair);
    if (has_stopped(a) || !trace_pair(a, c)) return false;
  }
  for (u32 i = 0; i < a.faces.size; ++i)
    if (!trace_sides(a, i)) return false;
  sort_by_facet(a);
  return true;
}

}  // namespace tpa
