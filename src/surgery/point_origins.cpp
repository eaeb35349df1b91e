// SPDX-License-Identifier: MIT
#include "surgery/point_origins.h"

#include "edit/bisect.h"

namespace tpa {

namespace {

// ---------------------------------------------------------------- one point

f64 share_along(const Vec3& a, const Vec3& b, const Vec3& p) {
  const f64 whole = squared_length(b - a);
  return whole > 0 ? min_of(1.0, max_of(0.0, dot(p - a, b - a) / whole)) : 0;
}

VertexOrigin origin_on_edge(const Mesh& m, u32 half_edge, const Vec3& p) {
  const u32 from = tail(m, half_edge), to = head(m, half_edge);
  return blend_origins(m, from, to, share_along(m.position[from], m.position[to], p));
}

// On the nearest edge of the face.
VertexOrigin origin_in_face(const Mesh& m, u32 f, const Vec3& p) {
  u32 nearest = none;
  f64 least = no_way;
  for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
    const Vec3 &from = corner_position(m, h), &to = corner_position(m, next_edge(h));
    const f64 t = share_along(from, to, p), off = squared_length(p - ((1 - t) * from + t * to));
    if (off < least) least = off, nearest = h;
  }
  return origin_on_edge(m, nearest == none ? 3 * f : nearest, p);
}

VertexOrigin origin_of(const Mesh& m, const ArrangementPoint& p) {
  switch (p.kind) {
    case PointKind::vertex: return blend_origins(m, p.id[0], p.id[0], 0);  // of a new vertex, even if of one parent
    case PointKind::edge_crossing: return origin_on_edge(m, p.id[0], p.at);
    case PointKind::plane_crossing: return origin_in_face(m, p.id[0], p.at);
  }
  return {};
}

// ---------------------------------------------------------------- sides of seams

// Do more than two pieces meet at the edge of a kept piece's half-edge?
bool is_seam(const Arrangement& a, u32 h) { return a.around[a.around[h]] != h; }

bool has_mate(const Arrangement& a, u32 h) { return (a.mate[h] & border_tag) == 0; }

// The next half-edge of the seam with the same sheet of the surface on its left; none at the rim of the pieces.
u32 next_on_seam(const Arrangement& a, u32 h) {
  u32 g = next_edge(h);
  while (!is_seam(a, g)) {
    if (!has_mate(a, g)) return none;
    g = next_edge(a.mate[g]);
  }
  return g;
}

template <class Visit>
void walk_seam(const Arrangement& a, u32 first, Visit visit) {
  for (u32 h = first; h != none;) {
    visit(h);
    h = next_on_seam(a, h);
    if (h == first) return;
  }
}

u8 seam_bit(u32 h) { return static_cast<u8>(1u << index_in_face(h)); }

// Notes for each point the half-edge from it along the side of its seam with the lowest face, in a.place; none for
// points beside all seams. a.vertex has that face.
void choose_sides(Arrangement& a) {
  for (u32 i = 0; i < a.points.list.size; ++i) a.place[i] = a.vertex[i] = none;
  for (u32 i = 0; i < a.pieces.size; ++i) a.reached[i] = 0;
  for (u32 first = 0; first < 3 * a.pieces.size; ++first) {
    if (!is_kept(a.pieces[face_of(first)]) || !is_seam(a, first)) continue;
    if ((a.reached[face_of(first)] & seam_bit(first)) != 0) continue;
    u32 lowest = none;
    walk_seam(a, first, [&](u32 h) { lowest = min_of(lowest, a.pieces[face_of(h)].face); });
    walk_seam(a, first, [&](u32 h) {
      a.reached[face_of(h)] |= seam_bit(h);
      const u32 p = point_at_tail(a, h);
      if (a.place[p] != none && a.vertex[p] <= lowest) return;
      a.place[p] = h;
      a.vertex[p] = lowest;
    });
  }
}

// The origin of a point on the left side of a half-edge that leaves it.
VertexOrigin origin_beside(const Mesh& m, const Arrangement& a, const ArrangementPoint& p, u32 h) {
  const u32 f = a.pieces[face_of(h)].face;
  if (p.kind == PointKind::vertex) return origin_of(m, p);
  if (p.kind == PointKind::edge_crossing && (face_of(p.id[0]) == f || face_of(m.opposite[p.id[0]]) == f))
    return origin_on_edge(m, p.id[0], p.at);
  return origin_in_face(m, f, p.at);
}

}  // namespace

void note_point_origins(const Mesh& m, Arrangement& a) {
  choose_sides(a);
  for (u32 i = 0; i < a.points.list.size; ++i) {
    const ArrangementPoint& p = a.points.list[i];
    a.origins[i] = a.place[i] == none ? origin_of(m, p) : origin_beside(m, a, p, a.place[i]);
  }
}

void forget_false_origins(Edit& e) {
  const Mesh& m = e.mesh;
  for (u32 f : e.journal.claims.faces) {
    if (f >= m.face_count || !face_lives(m, f) || m.face_origin[f] == none) continue;
    const u32 *now = m.corner + 3 * static_cast<size_t>(f), origin = m.face_origin[f];
    const u32* before =
        e.journal.faces.contains(origin) ? e.journal.face[origin].corner : m.corner + 3 * static_cast<size_t>(origin);
    bool all_old = true, same = true;
    for (u32 i = 0; i < 3; ++i) {
      all_old = all_old && is_old(m, now[i]);
      same = same && (now[i] == before[0] || now[i] == before[1] || now[i] == before[2]);
    }
    if (all_old && !same) m.face_origin[f] = none;
  }
}

}  // namespace tpa
