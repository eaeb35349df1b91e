#include "surgery/cut_and_sew.h"

namespace tpa {

namespace {

bool add_cut_vertices(Edit& e, Clusters& r, const CutLoop& loop) {
  for (u32 i = 0; i < loop.count; ++i) {
    Cut& c = r.cuts[loop.first + i];
    if (is_drawn(c)) continue;
    const u32 a = tail(e.mesh, c.half_edge), b = head(e.mesh, c.half_edge);
    const f64 t = 1 - 0.5 * c.seen;
    const Vec3 p = into_exact_range((1 - t) * e.mesh.position[a] + t * e.mesh.position[b]);
    c.vertex = new_vertex(e, p, blend_origins(e.mesh, a, b, t));
    if (c.vertex == none) return false;
  }
  return true;
}

// Without a branch: where a cluster ends is as good as random.
bool all_in_clusters(const Mesh& m, const Clusters& r, u32 f) {
  u32 inside = 1;
  for (u32 h = 3 * f; h < 3 * f + 3; ++h) inside &= u32{in_cluster(r, m.corner[h])};
  return inside != 0;
}

// rotate() reads opposites only, which deleted faces keep: the stars can be walked while they vanish.
void delete_inner_faces(Edit& e, NearFaces& g, const Clusters& r) {
  for (u32 v : r.members)
    for_each_outgoing(e.mesh, v, [&](u32 h) {
      const u32 f = face_of(h);
      if (!face_lives(e.mesh, f) || !all_in_clusters(e.mesh, r, f)) return;
      remove(g, f);
      delete_face(e, f);
    });
}

// What is left of the face between two consecutive cuts, and the half-edges that leave the first cut's vertex (left)
// and arrive at the second's (right) along the old edges.
struct Trimmed {
  u32 left, right;
};

// Face (c, r, s) with r outside, c and s in the cluster: the corner at r stays.
Trimmed trim_to_corner(Edit& e, Cut& here, const Cut& there) {
  const u32 h = here.half_edge;
  set_corner(e, h, here.vertex);
  set_corner(e, previous_edge(h), there.vertex);
  here.border = previous_edge(h);
  return {h, next_edge(h)};
}

// Face (c, r, s) with only c in the cluster: a quadrilateral stays, cut along its shorter diagonal. The half that holds
// the old edge r s stays in the old slot, so that edge needs no new neighbour. False where faces run out.
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

// Where one of the cuts, or both, are drawn back to their ends that stay: of a face with two of these a triangle stays,
// or nothing, and of a face with one of them nothing.
Trimmed trim_drawn(Edit& e, Cut& here, const Cut& there) {
  const u32 h = here.half_edge;
  if (!is_drawn(there)) {  // (x, r, s)
    set_corner(e, h, there.vertex);
    here.border = h;
    return {none, previous_edge(h)};
  }
  if (!is_drawn(here)) {  // (w, r, s)
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
  if (is_drawn(here) || is_drawn(there))
    out = trim_drawn(e, here, there);
  else if (in_cluster(r, apex(e.mesh, here.half_edge)))
    out = trim_to_corner(e, here, there);
  else if (!trim_to_quad(e, here, there, out, added))
    return false;
  if (here.border != none) {
    unlink(e, here.border);
    set_vertex_edge(e, here.vertex, is_drawn(here) ? next_edge(here.border) : out.left);
  }
  if (is_drawn(here) && is_drawn(there)) {
    remove(g, f);
    delete_face(e, f);
  } else {
    insert(g, e.mesh, f);
  }
  if (added != none) insert(g, e.mesh, added);
  return true;
}

// Of cuts drawn back to one vertex, the last one stands for all.
void drop_drawn(Clusters& r, CutLoop& loop) {
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
    else if (!is_drawn(here))
      link(e, now.left, last.right);
    last = now;
  }
  if (!is_drawn(r.cuts[loop.first])) link(e, first.left, last.right);
  drop_drawn(r, loop);
  return true;
}

}  // namespace

bool cut(Edit& e, NearFaces& g, Clusters& r) {
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
  // The half-edges by the vertices that they join, in an open hash that is half full.
  const u32 places = 6 * placed.size;
  const auto place_of = [&](u32 from, u32 to) {
    u32 at = static_cast<u32>(u64{scattered(from, to)} * places >> 32);
    const auto is_other = [&](u32 h) { return tail(m, h) != from || head(m, h) != to; };
    while (table[at] != none && is_other(table[at])) at = at + 1 < places ? at + 1 : 0;
    return at;
  };
  for (u32 i = 0; i < places; ++i) table[i] = none;
  for (u32 f : placed)
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) table[place_of(tail(m, h), head(m, h))] = h;
  const auto join = [&](u32 h) { link(e, h, table[place_of(head(m, h), tail(m, h))]); };
  // The edges of holes, beyond which borders run the other way; then nothing else is left without a neighbour.
  for (u32 b : borders) join(b);
  for (u32 f : placed)
    for (u32 h = 3 * f; h < 3 * f + 3; ++h)
      if (m.opposite[h] == none) join(h);
}

}  // namespace tpa
