// SPDX-License-Identifier: MIT
#include "surgery/cut_and_sew.h"

#include "base/open_hash.h"

namespace tpa {

namespace {

bool add_cut_vertices(Edit& e, Clusters& r, const CutLoop& loop) {
  for (u32 i = 0; i < loop.count; ++i) {
    Cut& c = r.cuts[loop.first + i];
    if (is_snapped(c)) continue;
    const u32 a = tail(e.mesh, c.half_edge), b = head(e.mesh, c.half_edge);
    const f64 t = 1 - 0.5 * c.seen;
    const Vec3 p = into_exact_range((1 - t) * e.mesh.position[a] + t * e.mesh.position[b]);
    c.vertex = new_vertex(e, p, blend_origins(e.mesh, a, b, t));
    if (c.vertex == none) return false;
  }
  return true;
}

bool all_in_clusters(const Mesh& m, const Clusters& r, u32 f) {
  const u32* c = m.corner + 3 * f;
  return in_cluster(r, c[0]) && in_cluster(r, c[1]) && in_cluster(r, c[2]);
}

// Deleted faces keep their opposites, and rotate() reads nothing else: stars can be walked while they vanish.
void delete_inner_faces(Edit& e, NearFaces& g, const Clusters& r) {
  for (u32 v : r.members)
    for_each_outgoing(e.mesh, v, [&](u32 h) {
      const u32 f = face_of(h);
      if (!face_lives(e.mesh, f) || !all_in_clusters(e.mesh, r, f)) return;
      remove(g, f);
      delete_face(e, f);
    });
}

// The rest of the face between two consecutive cuts has two half-edges along the old edges. `left` leaves the first
// cut's vertex; `right` arrives at the second cut's vertex. An edge that went whole has none.
struct Trimmed {
  u32 left, right;
};

// Face (c, r, s) with c and s in the cluster: the corner at r stays.
Trimmed trim_to_corner(Edit& e, Cut& here, const Cut& there) {
  const u32 h = here.half_edge;
  set_corner(e, h, here.vertex);
  set_corner(e, previous_edge(h), there.vertex);
  here.border = previous_edge(h);
  return {h, next_edge(h)};
}

// Face (c, r, s) with only c in the cluster: a quadrilateral stays, split along its shorter diagonal. The half with the
// old edge r s keeps the old slot, so this edge needs no new neighbour. False if faces run out.
bool trim_to_quad(Edit& e, Cut& here, const Cut& there, Trimmed& out, u32& added) {
  const u32 h = here.half_edge, rs = next_edge(h), f = face_of(h);
  const u32 w = here.vertex, x = there.vertex;
  const u32 r = tail(e.mesh, rs), s = head(e.mesh, rs);
  const Vec3* p = e.mesh.position;
  const bool from_w = squared_length(p[s] - p[w]) <= squared_length(p[r] - p[x]);
  added = from_w ? new_face(e, w, s, x, e.mesh.face_origin[f]) : new_face(e, w, r, x, e.mesh.face_origin[f]);
  if (added == none) return false;
  here.border = 3 * added + 2;
  if (from_w) {  // (w, r, s) and (w, s, x)
    set_corner(e, h, w);
    link(e, previous_edge(h), 3 * added);
    out = {h, 3 * added + 1};
  } else {  // (x, r, s) and (w, r, x)
    set_corner(e, h, x);
    link(e, h, 3 * added + 1);
    out = {3 * added, previous_edge(h)};
  }
  return true;
}

// Face (c, r, s) with snapped cuts. With one, r and s are outside and a triangle stays; with two, nothing stays.
Trimmed trim_snapped(Edit& e, Cut& here, const Cut& there) {
  const u32 h = here.half_edge;
  if (!is_snapped(there)) {  // (x, r, s)
    set_corner(e, h, there.vertex);
    here.border = h;
    return {none, previous_edge(h)};
  }
  if (!is_snapped(here)) {  // (w, r, s)
    set_corner(e, h, here.vertex);
    here.border = previous_edge(h);
    return {h, none};
  }
  if (here.vertex != there.vertex) here.border = e.mesh.opposite[next_edge(h)];
  return {none, none};
}

bool trim_face(Edit& e, NearFaces& g, const Clusters& r, Cut& here, const Cut& there, Trimmed& out) {
  const u32 f = face_of(here.half_edge);
  u32 added = none;
  if (is_snapped(here) || is_snapped(there))
    out = trim_snapped(e, here, there);
  else if (in_cluster(r, apex(e.mesh, here.half_edge)))
    out = trim_to_corner(e, here, there);
  else if (!trim_to_quad(e, here, there, out, added))
    return false;
  if (here.border != none) {
    unlink(e, here.border);
    set_vertex_edge(e, here.vertex, is_snapped(here) ? next_edge(here.border) : out.left);
  }
  if (is_snapped(here) && is_snapped(there)) {
    remove(g, f);
    delete_face(e, f);
  } else {
    insert(g, e.mesh, f);
  }
  if (added != none) insert(g, e.mesh, added);
  return true;
}

// Of consecutive cuts snapped to one vertex, the last stands for all.
void drop_snapped(Clusters& r, CutLoop& loop) {
  u32 kept = 0;
  for (u32 i = 0; i < loop.count; ++i)
    if (r.cuts[loop.first + i].border != none) move_cut(r, loop.first + i, loop.first + kept++);
  loop.count = kept;
}

bool trim_loop(Edit& e, NearFaces& g, Clusters& r, CutLoop& loop) {
  Trimmed first{none, none}, last{none, none};
  for (u32 i = 0; i < loop.count; ++i) {
    Cut& here = r.cuts[loop.first + i];
    Trimmed now;
    if (!trim_face(e, g, r, here, r.cuts[loop.first + (i + 1) % loop.count], now)) return false;
    if (i == 0)
      first = now;
    else if (!is_snapped(here))
      link(e, now.left, last.right);
    last = now;
  }
  if (!is_snapped(r.cuts[loop.first])) link(e, first.left, last.right);
  drop_snapped(r, loop);
  return true;
}

}  // namespace

bool cut(Edit& e, NearFaces& g, Clusters& r) {
  spend(g.meter, 8 * u64{r.members.size} + 8 * u64{r.cuts.size});
  for (const CutLoop& loop : r.loops)
    if (!add_cut_vertices(e, r, loop)) return false;
  delete_inner_faces(e, g, r);
  for (CutLoop& loop : r.loops)
    if (!trim_loop(e, g, r, loop)) return false;
  for (u32 v : r.members) delete_vertex(e, v);
  return true;
}

bool place(Edit& e, NearFaces& g, Span<const u32> vertices, Span<const FaceCorners> faces, Stack<u32>& placed) {
  const u32 from = placed.size;
  for (const FaceCorners& face : faces) {
    const u32 f = new_face(e, vertices[face.v[0]], vertices[face.v[1]], vertices[face.v[2]], none);
    if (f == none || !placed.push(f)) {
      if (f != none) delete_face(e, f);
      unplace(e, g, placed, from);
      return false;
    }
    insert(g, e.mesh, f);
  }
  return true;
}

void unplace(Edit& e, NearFaces& g, Stack<u32>& placed, u32 from) {
  while (placed.size > from) {
    const u32 f = placed.pop();
    remove(g, f);
    delete_face(e, f);
  }
}

void sew(Edit& e, Span<const u32> placed, Span<const u32> borders, u32* table) {
  const Mesh& m = e.mesh;
  // The half-edges of placed faces by the vertices that they join.
  OpenHash half_edges{table, 6 * placed.size};
  const auto half_edge_between = [&](u32 from, u32 to) -> u32& {
    return half_edges.find(scattered(from, to), [&](u32 h) { return tail(m, h) == from && head(m, h) == to; });
  };
  half_edges.clear();
  for (u32 f : placed)
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) half_edge_between(tail(m, h), head(m, h)) = h;
  const auto link_to_other = [&](u32 h) { link(e, h, half_edge_between(head(m, h), tail(m, h))); };
  // Edges of holes first, with borders on their other side; afterwards only edges between placed faces are left.
  for (u32 b : borders) link_to_other(b);
  for (u32 f : placed)
    for (u32 h = 3 * f; h < 3 * f + 3; ++h)
      if (m.opposite[h] == none) link_to_other(h);
}

}  // namespace tpa
