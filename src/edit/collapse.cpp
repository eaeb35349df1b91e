// SPDX-License-Identifier: MIT
#include "edit/collapse.h"

#include "detect/hub_stars.h"
#include "geometry/predicates.h"

namespace tpa {

namespace {

// The two vertices and their faces.
struct Merger {
  const u32 goes, stays;
  // Faces with one of the two vertices remain, as a fan round `stays`. A spoke is the half-edge of a face with the
  // vertex as tail.
  u32 fan = 0, spoke[largest_star];
  // Faces with both vertices go; `beside` has their third corners.
  u32 inner = 0, inner_face[2], beside[2];
  bool fits = true;  // all faces have room

  Merger(u32 go, u32 stay) : goes(go), stays(stay) {}
  bool has(u32 v) const { return v == goes || v == stays; }
};

// False without room.
bool add_face(const Mesh& m, Merger& g, u32 h) {
  const u32 x = head(m, h), y = apex(m, h);
  const bool inner = g.has(x) || g.has(y);
  if (inner ? g.inner == 2 : g.fan == largest_star) return false;
  if (!inner) {
    g.spoke[g.fan++] = h;
    return true;
  }
  g.inner_face[g.inner] = face_of(h);
  g.beside[g.inner++] = g.has(x) ? y : x;
  return true;
}

// Adds and marks the faces round the tail of a half-edge, as long as there is room: O(1) even at a hub.
void read_star(const Mesh& m, Merger& g, u32 first, u8* face_mark) {
  u32 h = first;
  do {
    u8& mark = face_mark[face_of(h)];
    if (mark == 0 && !add_face(m, g, h)) {
      g.fits = false;
      return;
    }
    mark = 1;
    h = rotate(m, h);
  } while (h != first);
}

// From the edge to `stays` on, if any.
void read_faces(const Mesh& m, Merger& g, u8* face_mark) {
  const u32 h = find_edge(m, g.goes, g.stays);
  read_star(m, g, h == none ? m.vertex_edge[g.goes] : h, face_mark);
  if (g.fits) read_star(m, g, m.vertex_edge[g.stays], face_mark);
}

void clear_marks(const Merger& g, u8* face_mark) {
  for (u32 i = 0; i < g.fan; ++i) face_mark[face_of(g.spoke[i])] = 0;
  for (u32 i = 0; i < g.inner; ++i) face_mark[g.inner_face[i]] = 0;
}

// Sorts the fan from neighbour to neighbour, across the last edge of each face. Is the rim a single closed polygon?
bool close_fan(const Mesh& m, Merger& g) {
  for (u32 i = 0; i + 1 < g.fan; ++i) {
    u32 k = i + 1;
    while (k < g.fan && head(m, g.spoke[k]) != apex(m, g.spoke[i])) ++k;
    if (k == g.fan) return false;
    swap_values(g.spoke[i + 1], g.spoke[k]);
  }
  return g.fan >= 3 && apex(m, g.spoke[g.fan - 1]) == head(m, g.spoke[0]);
}

// Do the corners of the rim differ, and keep three neighbours each?
bool keeps_rim(const Mesh& m, const Merger& g) {
  for (u32 i = 0; i < g.fan; ++i)
    for (u32 k = i + 1; k < g.fan; ++k)
      if (head(m, g.spoke[i]) == head(m, g.spoke[k])) return false;
  return has_more_faces(m, g.beside[0], 3) && has_more_faces(m, g.beside[1], 3);
}

// The surface keeps its topology if all faces of the merger form a disc. Equivalently, the link condition holds (Dey et
// al. 1999): the ends of the edge have no common neighbours but the two apexes.
bool is_disc(const Mesh& m, Merger& g) { return g.fits && g.inner == 2 && close_fan(m, g) && keeps_rim(m, g); }

bool all_turn_little(const Mesh& m, const Merger& g, const Vec3& to) {
  for (u32 i = 0; i < g.fan; ++i) {
    const Vec3 &x = m.position[head(m, g.spoke[i])], &y = m.position[apex(m, g.spoke[i])];
    if (!turns_little(area_normal(m.position[tail(m, g.spoke[i])], x, y), area_normal(to, x, y))) return false;
  }
  return true;
}

// The edges from both ends to a third corner become one, no longer than the longer of them.
bool may_stay_long(const Mesh& m, const Merger& g, u32 u, const EdgeAims& aims) {
  return aims.hubs_wait && g.inner == 2 && (u == g.beside[0] || u == g.beside[1]) && is_hub(m, u);
}

// May a third corner become a hub, so that the answer changes with faces far away? As long as it has too few faces for
// one, each change there asks again about all of its faces.
bool may_become_hub(const Mesh& m, const Merger& g) {
  return g.inner == 2 && (has_more_faces(m, g.beside[0], largest_star) || has_more_faces(m, g.beside[1], largest_star));
}

// Would the edges of `stays` be short enough? Asked first, since remeshing refuses most collapses for their edges.
bool edges_fit(const Mesh& m, const Merger& g, const Vec3& to, const EdgeAims& aims) {
  const f64 here = aim_between(aims, g.goes, g.stays);
  for (u32 i = 0; i < g.fan; ++i) {
    const u32 u = head(m, g.spoke[i]);
    const f64 aim = aims.length == nullptr ? here : 0.5 * (here + f64{aims.length[u]});
    const bool too_long = squared_length(m.position[u] - to) > square(aims.split * aim);
    if (too_long && !may_stay_long(m, g, u, aims)) return false;
  }
  return true;
}

// The volume of all faces of the merger, seen from a point, with a minus.
SignedVolume volume_lost(const Mesh& m, const Merger& g, const Vec3& from) {
  SignedVolume change;
  const auto drop = [&](u32 f) {
    add(change, -1, from, corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2));
  };
  for (u32 i = 0; i < g.fan; ++i) drop(face_of(g.spoke[i]));
  for (u32 i = 0; i < g.inner; ++i) drop(g.inner_face[i]);
  return change;
}

bool is_beside_hub(const Mesh& m, const Merger& g) {
  return g.inner == 2 && (is_hub(m, g.beside[0]) || is_hub(m, g.beside[1]));
}

// The place beside the middle of the edge, along the area vector of the rim, where the volume stays (Lindstrom & Turk
// 1998): the volume is linear in the place. The middle itself serves where this place lies farther from it than the
// ends do, or nowhere, since the faces are folded; and beside a hub, where a whole fan of needles may merge into one
// vertex: each merger would lift it a little more.
Vec3 place_of_same_volume(const Mesh& m, const Merger& g) {
  const Vec3 &a = m.position[g.goes], &b = m.position[g.stays], middle = midpoint(a, b);
  f64 six_volumes = 0;
  Vec3 twice_area;
  const auto add_corners = [&](u32 f) {
    const Vec3 p = corner_position(m, 3 * f) - middle, q = corner_position(m, 3 * f + 1) - middle,
               r = corner_position(m, 3 * f + 2) - middle;
    six_volumes += dot(p, cross(q, r));
    twice_area = twice_area + cross(q - p, r - p);
  };
  for (u32 i = 0; i < g.fan; ++i) add_corners(face_of(g.spoke[i]));
  for (u32 i = 0; i < g.inner; ++i) add_corners(g.inner_face[i]);
  const Vec3 way = six_volumes / squared_length(twice_area) * twice_area;
  const bool is_near = squared_length(way) <= 0.25 * squared_length(b - a);
  return into_exact_range(is_near && !is_beside_hub(m, g) ? middle + way : middle);
}

// Does a tetrahedron remain, flat or turned inside out? Its three faces round `stays` and the face beyond are all
// neighbours, so no contact would tell. Rare, so no filter comes first.
bool turns_inside_out(const Mesh& m, const Merger& g, const Vec3& to) {
  if (g.fan != 3) return false;
  const auto beyond = [&](u32 i) { return face_of(m.opposite[next_edge(g.spoke[i])]); };
  const u32 f = beyond(0);
  if (beyond(1) != f || beyond(2) != f) return false;
  const Vec3 &a = corner_position(m, 3 * f), &b = corner_position(m, 3 * f + 1), &c = corner_position(m, 3 * f + 2);
  return !(orient3d_exact(a, b, c, to) * volume_lost(m, g, a).sum > 0);
}

bool keeps_shape(const Mesh& m, Merger& g, const Vec3& to) {
  return is_disc(m, g) && all_turn_little(m, g, to) && !turns_inside_out(m, g, to);
}

void contract(Edit& e, NearFaces& near, const Merger& g) {
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
    remove(near, g.inner_face[i]);
    delete_face(e, g.inner_face[i]);
  }
  if (near.hubs != nullptr) forget_star(*near.hubs, g.goes);
  delete_vertex(e, g.goes);
  for (u32 i = 0; i < g.fan; ++i) insert(near, m, face_of(g.spoke[i]));
}

// The faces of the fan as they will be, but for those that lie as before: these stay in the mesh, and lose their marks.
u32 make_trials(const Mesh& m, const Merger& g, const Vec3& to, u8* face_mark, FaceCorners* trials) {
  const bool in_place = m.position[g.stays] == to;
  u32 n = 0;
  for (u32 i = 0; i < g.fan; ++i)
    if (in_place && tail(m, g.spoke[i]) == g.stays)
      face_mark[face_of(g.spoke[i])] = 0;
    else
      trials[n++] = {{g.stays, head(m, g.spoke[i]), apex(m, g.spoke[i])}};
  return n;
}

// Moves `stays`. Back again, and false, if a face of the fan would meet something.
bool move_freely(Edit& e, const NearFaces& near, const Merger& g, const Vec3& to, Expected expected, u8* face_mark) {
  const Mesh& m = e.mesh;
  const Vec3 old = m.position[g.stays];
  FaceCorners trials[largest_star];
  const u32 n = make_trials(m, g, to, face_mark, trials);
  if (near.hubs != nullptr && near.tree->has_hubs) know_stars(*near.hubs, m, near.meter, trials, n);
  set_position(e, g.stays, to);
  const bool free = trials_are_free(m, near, face_mark, trials, n, expected);
  if (!free) m.position[g.stays] = old;
  return free;
}

void finish(Edit& e, NearFaces& near, const Merger& g, const VertexOrigin& origin) {
  contract(e, near, g);
  e.mesh.vertex_origin[g.stays] = origin;
}

// Units of work, without the search of near faces.
constexpr u64 of_contraction = 10;

}  // namespace

bool contract_edge(Edit& e, NearFaces& near, u32 goes, u32 stays, u8* face_mark) {
  Merger merger(goes, stays);
  spend(near.meter, of_contraction);
  read_faces(e.mesh, merger, face_mark);
  const bool good = is_disc(e.mesh, merger);
  clear_marks(merger, face_mark);
  if (good) contract(e, near, merger);
  return good;
}

bool collapse(Edit& e, NearFaces& near, u32 goes, u32 stays, const Vec3& to, const VertexOrigin& origin,
              Expected expected, u8* face_mark) {
  Merger merger(goes, stays);
  spend(near.meter, of_contraction);
  read_faces(e.mesh, merger, face_mark);
  const bool good = keeps_shape(e.mesh, merger, to) && move_freely(e, near, merger, to, expected, face_mark);
  clear_marks(merger, face_mark);
  if (good) finish(e, near, merger, origin);
  return good;
}

Collapse collapse_short_edge(Edit& e, NearFaces& near, u32 goes, u32 stays, const EdgeAims& aims, u8* face_mark,
                             VolumesOnDemand& volumes) {
  const Mesh& m = e.mesh;
  Merger merger(goes, stays);
  spend(near.meter, of_contraction);
  read_faces(m, merger, face_mark);
  const Vec3 to = place_of_same_volume(m, merger);
  const bool barred = !edges_fit(m, merger, to, aims) || !keeps_shape(m, merger, to);
  // Seen from `to`, the remaining faces enclose nothing.
  const SignedVolume change = barred ? SignedVolume{} : volume_lost(m, merger, to);
  const bool good = !barred && stays_outside_out(measured(volumes, m), stays, change) &&
                    move_freely(e, near, merger, to, Expected::flat, face_mark);
  clear_marks(merger, face_mark);
  if (!good) return barred && !may_become_hub(m, merger) ? Collapse::barred : Collapse::refused;
  note_change(volumes.components, stays, change);
  finish(e, near, merger, blend_origins(m, goes, stays, 0.5));
  return Collapse::done;
}

}  // namespace tpa
