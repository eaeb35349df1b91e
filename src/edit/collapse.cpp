#include "edit/collapse.h"

#include "geometry/predicates.h"

namespace tpa {

namespace {

// The vertices that become one, and the faces that have them for corners.
struct Merger {
  const u32 goes, stays;
  // Faces with one of the two: the half-edge that leaves it. They are what is left, a fan round what stays.
  u32 fan = 0, spoke[largest_star];
  // Faces with both, which go, and their third corners.
  u32 inner = 0, inner_face[2], beside[2];
  bool fits = true;

  Merger(u32 go, u32 stay) : goes(go), stays(stay) {}
  bool has(u32 v) const { return v == goes || v == stays; }
};

// What goes, from the edge to what stays, where there is one.
template <class Visit>
void for_each_star(const Mesh& m, const Merger& g, Visit visit) {
  const u32 h = find_edge(m, g.goes, g.stays);
  for_each_outgoing_from(m, h == none ? m.vertex_edge[g.goes] : h, visit);
  for_each_outgoing(m, g.stays, visit);
}

void add_face(const Mesh& m, Merger& g, u32 h) {
  const u32 x = head(m, h), y = apex(m, h);
  const bool inner = g.has(x) || g.has(y);
  g.fits = g.fits && (inner ? g.inner < 2 : g.fan < largest_star);
  if (!g.fits) return;
  if (!inner) {
    g.spoke[g.fan++] = h;
    return;
  }
  g.inner_face[g.inner] = face_of(h);
  g.beside[g.inner++] = g.has(x) ? y : x;
}

// Marks the faces on the way.
void read_faces(const Mesh& m, Merger& g, u8* face_mark) {
  for_each_star(m, g, [&](u32 h) {
    if (face_mark[face_of(h)] != 0) return;
    face_mark[face_of(h)] = 1;
    add_face(m, g, h);
  });
}

// Puts the fan in order, each face followed by the one that has its last corner first. Is its rim one closed polygon?
bool close_fan(const Mesh& m, Merger& g) {
  for (u32 i = 0; i + 1 < g.fan; ++i) {
    u32 k = i + 1;
    while (k < g.fan && head(m, g.spoke[k]) != apex(m, g.spoke[i])) ++k;
    if (k == g.fan) return false;
    swap_values(g.spoke[i + 1], g.spoke[k]);
  }
  return g.fan >= 3 && apex(m, g.spoke[g.fan - 1]) == head(m, g.spoke[0]);
}

// Are all corners of the rim different, and do they keep three neighbours each?
bool keeps_rim(const Mesh& m, const Merger& g) {
  for (u32 i = 0; i < g.fan; ++i)
    for (u32 k = i + 1; k < g.fan; ++k)
      if (head(m, g.spoke[i]) == head(m, g.spoke[k])) return false;
  return valence(m, g.beside[0]) > 3 && valence(m, g.beside[1]) > 3;
}

// The surface stays what it is where all these faces make a disc: the link condition (Dey et al. 1999) is that the ends
// of the edge have just its two apexes as common neighbours.
bool is_disc(const Mesh& m, Merger& g) { return g.fits && g.inner == 2 && close_fan(m, g) && keeps_rim(m, g); }

bool all_turn_little(const Mesh& m, const Merger& g, const Vec3& to) {
  for (u32 i = 0; i < g.fan; ++i) {
    const Vec3 &x = m.position[head(m, g.spoke[i])], &y = m.position[apex(m, g.spoke[i])];
    if (!turns_little(area_normal(m.position[tail(m, g.spoke[i])], x, y), area_normal(to, x, y))) return false;
  }
  return true;
}

// Would the edges of the vertex that stays be short enough? Asked first: of the short edges that remeshing finds, most
// are refused for that.
bool edges_fit(const Mesh& m, const Merger& g, const Vec3& to, f64 most_squared_length) {
  for (u32 i = 0; i < g.fan; ++i)
    if (squared_length(m.position[head(m, g.spoke[i])] - to) > most_squared_length) return false;
  return true;
}

// What all these faces enclose, seen from a point, taken away.
SixVolumes volume_lost(const Mesh& m, const Merger& g, const Vec3& from) {
  SixVolumes change;
  const auto drop = [&](u32 f) {
    add(change, -1, from, corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2));
  };
  for (u32 i = 0; i < g.fan; ++i) drop(face_of(g.spoke[i]));
  for (u32 i = 0; i < g.inner; ++i) drop(g.inner_face[i]);
  return change;
}

// Where three faces are left round the vertex and one beyond them, all are neighbours, and none meets another even if
// the tetrahedron is inside out. Is it, compared to what it was, or flat? So seldom asked that no filter comes first.
bool turns_inside_out(const Mesh& m, const Merger& g, const Vec3& to) {
  if (g.fan != 3) return false;
  const auto beyond = [&](u32 i) { return face_of(m.opposite[next_edge(g.spoke[i])]); };
  const u32 f = beyond(0);
  if (beyond(1) != f || beyond(2) != f) return false;
  const Vec3 &a = corner_position(m, 3 * f), &b = corner_position(m, 3 * f + 1), &c = corner_position(m, 3 * f + 2);
  return !(orient3d_exact(a, b, c, to) * volume_lost(m, g, a).sum > 0);
}

void contract(Edit& e, NearFaces& near_faces, const Merger& g) {
  const Mesh& m = e.mesh;
  for (u32 i = 0; i < g.fan; ++i) {
    const u32 spoke = g.spoke[i], next = g.spoke[i + 1 == g.fan ? 0 : i + 1], back = previous_edge(spoke);
    if (tail(m, spoke) != g.stays) set_corner(e, spoke, g.stays);
    if (m.opposite[back] != next) link(e, back, next);
    for (u32 k = 0; k < g.inner; ++k)
      if (g.beside[k] == tail(m, back)) set_vertex_edge(e, g.beside[k], back);
  }
  set_vertex_edge(e, g.stays, g.spoke[0]);
  for (u32 i = 0; i < g.inner; ++i) {
    remove(near_faces, g.inner_face[i]);
    delete_face(e, g.inner_face[i]);
  }
  delete_vertex(e, g.goes);
  for (u32 i = 0; i < g.fan; ++i) insert(near_faces, m, face_of(g.spoke[i]));
}

}  // namespace

bool collapse(Edit& e, NearFaces& g, u32 goes, u32 stays, const Vec3& to, const VertexOrigin& origin,
              f64 most_squared_length, Expected expected, u8* face_mark, Components* enclosed) {
  Mesh& m = e.mesh;
  Merger merger(goes, stays);
  read_faces(m, merger, face_mark);
  const Vec3 old = m.position[stays];
  bool good = edges_fit(m, merger, to, most_squared_length) && is_disc(m, merger) && all_turn_little(m, merger, to) &&
              !turns_inside_out(m, merger, to);
  SixVolumes change;
  if (good && enclosed != nullptr) {
    // From there, the faces that are left enclose nothing.
    change = volume_lost(m, merger, to);
    good = stays_outside_out(*enclosed, stays, change);
  }
  if (good) {
    set_position(e, stays, to);
    Trial trials[largest_star];
    for (u32 i = 0; i < merger.fan; ++i) trials[i] = {{stays, head(m, merger.spoke[i]), apex(m, merger.spoke[i])}};
    good = trials_are_free(m, g, face_mark, trials, merger.fan, expected);
    if (!good) m.position[stays] = old;
  }
  for_each_star(m, merger, [&](u32 h) { face_mark[face_of(h)] = 0; });
  if (!good) return false;
  if (enclosed != nullptr) note_change(*enclosed, stays, change);
  contract(e, g, merger);
  m.vertex_origin[stays] = origin;
  return true;
}

}  // namespace tpa
