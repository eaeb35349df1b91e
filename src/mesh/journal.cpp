// SPDX-License-Identifier: MIT
#include "mesh/journal.h"

#include <string.h>

namespace tpa {

namespace {

constexpr VertexOrigin itself(u32 v) { return {{v, none}, 1.0f}; }

u32* corners_of(const Mesh& m, u32 f) { return m.corner + 3 * f; }

void save_face(Edit& e, u32 f, u32 origin) {
  OldFace& old = e.journal.face[f];
  memcpy(old.corner, corners_of(e.mesh, f), sizeof old.corner);
  old.origin = origin;
}

inline void save_vertex(Edit& e, u32 v, const VertexOrigin& origin) {
  e.journal.position[v] = e.mesh.position[v];
  e.journal.vertex[v] = {origin, e.mesh.vertex_edge[v]};
}

}  // namespace

void begin(Edit& e) {
  Journal& j = e.journal;
  Mesh& m = e.mesh;
  j.vertex_count = m.vertex_count;
  j.face_count = m.face_count;
  m.free_vertex = m.free_face = j.resting_vertex = j.resting_face = none;
  j.vertices.cut_off(m.vertex_count);
  j.faces.cut_off(m.face_count);
  for (u32 v : j.vertices) {
    save_vertex(e, v, m.vertex_origin[v]);
    m.vertex_origin[v] = itself(v);
  }
  for (u32 f : j.faces) {
    save_face(e, f, m.face_origin[f]);
    m.face_origin[f] = f;
  }
}

namespace {

// Calls visit(h) for the half-edges of the faces of a set, as far as they were there before the transaction.
template <class Visit>
void for_each_old_half_edge(const Journal& j, const BitSet& faces, Visit visit) {
  for (u32 f : faces)
    if (f < j.face_count)
      for (u32 h = 3 * f; h < 3 * f + 3; ++h) visit(h);
}

// A slot of the hash below for the edge of h, the same for both half-edges.
u32 edge_slot(const Mesh& m, u32 h) {
  const u32 a = min_of(tail(m, h), head(m, h)), b = max_of(tail(m, h), head(m, h));
  return static_cast<u32>(u64{scattered(a, b)} * m.vertex_count >> 32);
}

// Parts the half-edges between faces of the set: edits have parted them, or have used their slots otherwise.
void unlink_within(Edit& e, const BitSet& faces) {
  Mesh& m = e.mesh;
  for_each_old_half_edge(e.journal, faces, [&](u32 h) {
    if (m.opposite[h] != none && faces.contains(face_of(m.opposite[h]))) m.opposite[h] = none;
  });
}

// Pairs the half-edges of the set without an opposite. Half-edges waiting for their partner form chains by edge. A
// chain begins in waiting(slot) and runs on through `opposite`.
template <class Waiting>
void pair_half_edges(Edit& e, const BitSet& faces, Waiting waiting) {
  const Mesh& m = e.mesh;
  for_each_old_half_edge(e.journal, faces, [&](u32 h) {
    if (m.opposite[h] == none) waiting(edge_slot(m, h)) = none;
  });
  for_each_old_half_edge(e.journal, faces, [&](u32 h) {
    if (m.opposite[h] != none) return;
    u32& first = waiting(edge_slot(m, h));
    u32* link = &first;
    while (*link != none && !(tail(m, *link) == head(m, h) && head(m, *link) == tail(m, h))) link = &m.opposite[*link];
    const u32 g = *link;
    if (g == none) {
      m.opposite[h] = first;
      first = h;
      return;
    }
    *link = m.opposite[g];
    m.opposite[g] = h;
    m.opposite[h] = g;
  });
}

void restore_vertex(Edit& e, u32 v) {
  e.mesh.position[v] = e.journal.position[v];
  e.mesh.vertex_edge[v] = e.journal.vertex[v].edge;
  e.mesh.vertex_origin[v] = e.journal.vertex[v].origin;
}

void restore_face(Edit& e, u32 f) {
  memcpy(corners_of(e.mesh, f), e.journal.face[f].corner, sizeof e.journal.face[f].corner);
  e.mesh.face_origin[f] = e.journal.face[f].origin;
}

}  // namespace

void rollback(Edit& e) {
  Journal& j = e.journal;
  Mesh& m = e.mesh;
  unlink_within(e, j.faces);
  for (u32 v : j.vertices) {
    if (v < j.vertex_count)
      restore_vertex(e, v);
    else
      m.vertex_origin[v] = itself(v);  // beyond the mesh all slots are identities
  }
  for (u32 f : j.faces) {
    if (f < j.face_count)
      restore_face(e, f);
    else
      m.face_origin[f] = f;
  }
  m.vertex_count = j.vertex_count;
  m.face_count = j.face_count;
  // The saved edges of vertices are needed no more.
  pair_half_edges(e, j.faces, [&](u32 slot) -> u32& { return j.vertex[slot].edge; });
  m.free_vertex = m.free_face = none;
  j.vertices.cut_off(m.vertex_count);
  j.faces.cut_off(m.face_count);
}

void take_back_claims(Edit& e, const Slots& before, u32* waiting) {
  Journal& j = e.journal;
  Mesh& m = e.mesh;
  unlink_within(e, j.claims.faces);
  // Within a transaction each old element is its own origin; saved are the origins of the commit before.
  for (u32 v : j.claims.vertices) {
    if (v < j.vertex_count) restore_vertex(e, v);
    m.vertex_origin[v] = itself(v);
  }
  for (u32 f : j.claims.faces) {
    if (f < j.face_count) restore_face(e, f);
    m.face_origin[f] = f;
  }
  m.vertex_count = before.vertices;
  m.face_count = before.faces;
  m.free_vertex = before.free_vertex;
  m.free_face = before.free_face;
  pair_half_edges(e, j.claims.faces, [&](u32 slot) -> u32& { return waiting[slot]; });
  j.vertices.cut_off(m.vertex_count);
  j.faces.cut_off(m.face_count);
}

// A vertex or face not saved by begin() is its own origin, so the origin in the mesh need not be read.
void save_vertex(Edit& e, u32 v) {
  e.journal.vertices.add(v);
  save_vertex(e, v, itself(v));
}

void touch_face(Edit& e, u32 f) {
  if (e.journal.faces.add(f)) save_face(e, f, f);
  if (e.journal.claims.owner != none) e.journal.claims.claim_face(f);
}

u32 new_vertex(Edit& e, const Vec3& p, const VertexOrigin& origin) {
  Mesh& m = e.mesh;
  u32 v = m.free_vertex;
  if (v != e.journal.resting_vertex) {
    m.free_vertex = m.vertex_origin[v].parents[0];
  } else {
    if (m.vertex_count == m.vertex_capacity - e.journal.spare_vertices) return none;
    v = m.vertex_count++;
    m.vertex_edge[v] = none;
    touch_vertex(e, v);
  }
  m.position[v] = p;
  m.vertex_origin[v] = origin;
  return v;
}

u32 new_face(Edit& e, u32 a, u32 b, u32 c, u32 origin) {
  Mesh& m = e.mesh;
  u32 f = m.free_face;
  if (f != e.journal.resting_face) {
    m.free_face = m.corner[3 * f + 1];
  } else {
    if (m.face_count == m.face_capacity - e.journal.spare_faces) return none;
    f = m.face_count++;
    touch_face(e, f);
  }
  m.corner[3 * f] = a;
  m.corner[3 * f + 1] = b;
  m.corner[3 * f + 2] = c;
  for (u32 i = 0; i < 3; ++i) m.opposite[3 * f + i] = none;
  m.face_origin[f] = origin;
  return f;
}

void allow_slots(Edit& e, u64 vertices, u64 faces) {
  const Mesh& m = e.mesh;
  e.journal.spare_vertices = m.vertex_capacity - static_cast<u32>(min_of<u64>(m.vertex_capacity, vertices));
  e.journal.spare_faces = m.face_capacity - static_cast<u32>(min_of<u64>(m.face_capacity, faces));
}

bool has_free_vertices(const Edit& e, u32 count) {
  const Mesh& m = e.mesh;
  u32 free = m.vertex_capacity - e.journal.spare_vertices - m.vertex_count;
  for (u32 v = m.free_vertex; free < count && v != e.journal.resting_vertex; v = m.vertex_origin[v].parents[0]) ++free;
  return free >= count;
}

void delete_vertex(Edit& e, u32 v) {
  touch_vertex(e, v);
  Mesh& m = e.mesh;
  m.vertex_edge[v] = none;
  m.vertex_origin[v].parents[0] = m.free_vertex;
  m.free_vertex = v;
}

void delete_face(Edit& e, u32 f) {
  Mesh& m = e.mesh;
  touch_face(e, f);
  for (u32 h = 3 * f; h < 3 * f + 3; ++h)
    if (m.opposite[h] != none) touch_face(e, face_of(m.opposite[h]));
  m.corner[3 * f] = none;
  m.corner[3 * f + 1] = m.free_face;
  m.free_face = f;
}

VertexOrigin blend_origins(const Mesh& m, u32 a, u32 b, f64 t) {
  u32 id[4];
  f64 weight[4];
  u32 n = 0;
  const auto add = [&](u32 parent, f64 w) {
    if (parent == none || w == 0) return;
    for (u32 i = 0; i < n; ++i)
      if (id[i] == parent) {
        weight[i] += w;
        return;
      }
    id[n] = parent;
    weight[n++] = w;
  };
  const VertexOrigin &p = m.vertex_origin[a], &q = m.vertex_origin[b];
  add(p.parents[0], (1 - t) * f64{p.weight});
  add(p.parents[1], (1 - t) * (1 - f64{p.weight}));
  add(q.parents[0], t * f64{q.weight});
  add(q.parents[1], t * (1 - f64{q.weight}));
  // The two heaviest, ties by the lower id, to the front.
  for (u32 i = 0; i < 2 && i < n; ++i)
    for (u32 k = i + 1; k < n; ++k)
      if (weight[k] > weight[i] || (weight[k] == weight[i] && id[k] < id[i])) {
        swap_values(weight[i], weight[k]);
        swap_values(id[i], id[k]);
      }
  if (n == 1) return {{id[0], id[0]}, 1.0f};
  return {{id[0], id[1]}, static_cast<f32>(weight[0] / (weight[0] + weight[1]))};
}

namespace {

// A commit is final. So only corners are saved any more, for note_changes(), and the sets note the vertices and faces
// with new numbers.
void move_vertex(Edit& e, u32 from, u32 to) {
  Mesh& m = e.mesh;
  e.journal.vertices.add(from);
  e.journal.vertices.add(to);
  for_each_outgoing(m, from, [&](u32 h) { set_corner(e, h, to); });
  m.position[to] = m.position[from];
  m.vertex_edge[to] = m.vertex_edge[from];
  m.vertex_origin[to] = m.vertex_origin[from];
  m.vertex_edge[from] = none;
}

void move_face(Edit& e, u32 from, u32 to) {
  Mesh& m = e.mesh;
  e.journal.faces.add(from);
  e.journal.faces.add(to);
  for (u32 g = 3 * from, h = 3 * to; h < 3 * to + 3; ++g, ++h) {
    const u32 v = m.corner[g], beyond = m.opposite[g];
    m.corner[h] = v;
    m.opposite[h] = beyond;
    m.opposite[beyond] = h;
    if (m.vertex_edge[v] == g) m.vertex_edge[v] = h;
  }
  m.face_origin[to] = m.face_origin[from];
  m.corner[3 * from] = none;
  face_moved_to(m, from) = to;
}

}  // namespace

void note_changes(const Edit& e, BitSet vertices, BitSet faces) {
  const Mesh& m = e.mesh;
  const Journal& j = e.journal;
  vertices.cut_off(0);
  faces.cut_off(0);
  for (u32 v : j.vertices)
    if (v < m.vertex_count && (v >= j.vertex_count || !have_same_bits(j.position[v], m.position[v]))) vertices.add(v);
  for (u32 f : j.faces)
    if (f < m.face_count && (f >= j.face_count || memcmp(j.face[f].corner, corners_of(m, f), 3 * sizeof(u32)) != 0))
      faces.add(f);
}

namespace {

// Is an entry of the maps other than the identity?
bool is_mapped(const Mesh& m, const u32* old_to_new, u32 v) {
  const VertexOrigin& o = m.vertex_origin[v];
  return v < m.vertex_count && (o.parents[0] != v || o.parents[1] != none || old_to_new[v] != v);
}

}  // namespace

void note_mapped(Edit& e, const u32* old_to_new) {
  const Mesh& m = e.mesh;
  for (u32 v = 0; v < m.vertex_count; ++v)
    if (is_mapped(m, old_to_new, v)) e.journal.vertices.add(v);
  for (u32 f = 0; f < m.face_count; ++f)
    if (m.face_origin[f] != f) e.journal.faces.add(f);
}

void forget_unmapped(Edit& e, const u32* old_to_new) {
  const Mesh& m = e.mesh;
  for (u32 v : e.journal.vertices)
    if (!is_mapped(m, old_to_new, v)) e.journal.vertices.remove(v);
  for (u32 f : e.journal.faces)
    if (f >= m.face_count || m.face_origin[f] == f) e.journal.faces.remove(f);
}

void reset_map(const Edit& e, u32* old_to_new, u32 old_count) {
  // begin() carried the vertices of the last commit into this transaction's set.
  for (u32 v : e.journal.vertices) old_to_new[v] = v;
  // The last commit cut vertices off the end, without a note in any set.
  for (u32 v = e.journal.vertex_count; v < old_count; ++v) old_to_new[v] = v;
}

void commit(Edit& e, u32* old_to_new, u32* label) {
  Mesh& m = e.mesh;
  Journal& j = e.journal;
  // A vertex moved into a hole overwrites the hole's link in the free list, so `following` is read first.
  for (u32 v = m.free_vertex; v != none;) {
    const u32 following = m.vertex_origin[v].parents[0];
    while (m.vertex_count > 0 && !vertex_lives(m, m.vertex_count - 1)) --m.vertex_count;
    if (v < m.vertex_count) {
      const u32 from = --m.vertex_count;
      move_vertex(e, from, v);
      label[v] = label[from];
      label[from] = v;
    }
    v = following;
  }
  for (u32 f = m.free_face; f != none;) {
    const u32 following = m.corner[3 * f + 1];
    while (m.face_count > 0 && !face_lives(m, m.face_count - 1)) --m.face_count;
    if (f < m.face_count)
      move_face(e, --m.face_count, f);
    else
      face_moved_to(m, f) = none;
    f = following;
  }
  m.free_vertex = m.free_face = none;
  for (u32 v : j.vertices)
    if (v < j.vertex_count) old_to_new[v] = none;
  for (u32 v : j.vertices)
    if (v < m.vertex_count && is_old(m, v)) old_to_new[m.vertex_origin[v].parents[0]] = v;
}

}  // namespace tpa
