#include "collapse.h"

#include "predicates.h"

namespace tpa {

namespace {

// The vertices that become one, and the faces that have them for corners.
struct Merger {
  const Span<const Going> gone;
  const u32 stays;
  // Faces with one of the vertices: the half-edge that leaves it. They are what is left, a fan round what stays.
  u32 fan = 0, spoke[largest_star];
  // Faces with two or three of them, which go, and the corner of the former that is none of them, or none.
  u32 inner = 0, inner_face[largest_star], beside[largest_star];
  bool fits = true;

  Merger(Span<const Going> go, u32 stay) : gone(go), stays(stay) {}
  bool has(u32 v) const {
    bool found = v == stays;
    for (const Going& u : gone) found = found || v == u.vertex;
    return found;
  }
};

template <class Visit>
void for_each_star(const Mesh& m, const Merger& g, Visit visit) {
  // Each from the edge to what stays, where there is one.
  for (const Going& u : g.gone) {
    const u32 h = find_edge(m, u.vertex, g.stays);
    for_each_outgoing_from(m, h == none ? m.vertex_edge[u.vertex] : h, visit);
  }
  for_each_outgoing(m, g.stays, visit);
}

void add_face(const Mesh& m, Merger& g, u32 h) {
  const u32 x = head(m, h), y = apex(m, h);
  const bool has_x = g.has(x), has_y = g.has(y);
  if (!has_x && !has_y) {
    g.fits = g.fits && g.fan < largest_star;
    if (g.fits) g.spoke[g.fan++] = h;
    return;
  }
  g.fits = g.fits && g.inner < largest_star;
  if (!g.fits) return;
  g.inner_face[g.inner] = face_of(h);
  g.beside[g.inner++] = !has_x ? x : !has_y ? y : none;
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
  for (u32 i = 0; i < g.inner; ++i) {
    if (g.beside[i] == none) continue;
    u32 lost = 0;
    for (u32 k = 0; k < g.inner; ++k) lost += g.beside[k] == g.beside[i] ? 1 : 0;
    if (valence(m, g.beside[i]) < 3 + lost) return false;
  }
  return true;
}

// The surface stays what it is where all these faces make a disc. For one edge this is the link condition (Dey et al.
// 1999): its ends have just the two apexes of the edge as common neighbours. By Euler's formula a disc with s vertices
// within and n on its rim has 2 s + n - 2 faces.
bool is_disc(const Mesh& m, Merger& g) {
  const u32 within = g.gone.size + 1;
  return g.fits && g.fan + g.inner == 2 * within + g.fan - 2 && close_fan(m, g) && keeps_rim(m, g);
}

// Does a face turn little when `number` vertices are one already, at `at`, and take in the next one?
bool turns_little(const Mesh& m, const Merger& g, u32 face, u32 number, const Vec3& at) {
  const Going& next = g.gone[number];
  Vec3 before[3], after[3];
  u32 merged = 0;
  for (u32 i = 0; i < 3; ++i) {
    const u32 v = m.corner[3 * face + i];
    bool taken = v == g.stays;
    for (u32 k = 0; k < number; ++k) taken = taken || v == g.gone[k].vertex;
    before[i] = taken ? at : m.position[v];
    after[i] = taken || v == next.vertex ? next.to : before[i];
    merged += taken || v == next.vertex ? 1 : 0;
  }
  // Of others nothing is left, or nothing changes.
  return merged != 1 ||
         turns_little(area_normal(before[0], before[1], before[2]), area_normal(after[0], after[1], after[2]));
}

bool all_turn_little(const Mesh& m, const Merger& g) {
  Vec3 at = m.position[g.stays];
  for (u32 number = 0; number < g.gone.size; ++number) {
    for (u32 i = 0; i < g.fan; ++i)
      if (!turns_little(m, g, face_of(g.spoke[i]), number, at)) return false;
    for (u32 i = 0; i < g.inner; ++i)
      if (!turns_little(m, g, g.inner_face[i], number, at)) return false;
    at = g.gone[number].to;
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
[[gnu::cold]] bool turns_inside_out(const Mesh& m, const Merger& g, const Vec3& to) {
  if (g.fan != 3) return false;
  const auto beyond = [&](u32 i) { return face_of(m.opposite[next_edge(g.spoke[i])]); };
  const u32 f = beyond(0);
  if (beyond(1) != f || beyond(2) != f) return false;
  const Vec3 &a = corner_position(m, 3 * f), &b = corner_position(m, 3 * f + 1), &c = corner_position(m, 3 * f + 2);
  return !(orient3d_exact(a, b, c, to) * volume_lost(m, g, a).sum > 0);
}

void contract(Edit& e, Grid& grid, const Merger& g) {
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
    remove(grid, g.inner_face[i]);
    delete_face(e, g.inner_face[i]);
  }
  for (const Going& u : g.gone) delete_vertex(e, u.vertex);
  for (u32 i = 0; i < g.fan; ++i) {
    remove(grid, face_of(g.spoke[i]));
    insert(grid, m, face_of(g.spoke[i]));
  }
}

}  // namespace

bool collapse(Edit& e, Grid& g, Span<const Going> gone, u32 stays, const VertexOrigin& origin, f64 most_squared_length,
              Expected expected, u8* face_mark, Components* enclosed) {
  Mesh& m = e.mesh;
  Merger merger(gone, stays);
  read_faces(m, merger, face_mark);
  const Vec3 old = m.position[stays], new_place = gone[gone.size - 1].to;
  bool good = edges_fit(m, merger, new_place, most_squared_length) && is_disc(m, merger) && all_turn_little(m, merger) &&
              !turns_inside_out(m, merger, new_place);
  SixVolumes change;
  if (good && enclosed != nullptr) {
    // From there, the faces that are left enclose nothing.
    change = volume_lost(m, merger, new_place);
    good = stays_outside_out(*enclosed, stays, change);
  }
  if (good) {
    set_position(e, stays, new_place);
    Trial trials[largest_star];
    for (u32 i = 0; i < merger.fan; ++i)
      trials[i] = {{stays, head(m, merger.spoke[i]), apex(m, merger.spoke[i])}};
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
