// SPDX-License-Identifier: MIT
// half_edges: the closed triangle mesh as a half-edge table, and queries of neighbours (section 2).
// Half-edge h = 3 * face + i runs from corner i to corner i + 1 of its face, with the face on the left.
#pragma once

#include "base/vec3.h"

namespace tpa {

// The origin of a vertex, in ids before the transaction. An old vertex has {id, none} and weight 1; of a new
// vertex, weight is the share of parents[0], and the rest that of parents[1].
struct VertexOrigin {
  u32 parents[2];
  f32 weight;
};
// Of a new vertex: no place between old vertices near enough is known, only some old vertex (results/true_origins.h).
constexpr VertexOrigin untrue_origin(u32 v) { return {{v, v}, 0}; }
constexpr bool is_untrue(const VertexOrigin& o) { return o.parents[0] == o.parents[1] && o.weight == 0; }

struct Mesh {
  Vec3* position = nullptr;
  u32* vertex_edge = nullptr;  // an outgoing half-edge; none: the slot is a hole
  VertexOrigin* vertex_origin = nullptr;
  u32* corner = nullptr;       // tail of the half-edge; corner[3 f] == none: face slot f is a hole
  u32* opposite = nullptr;     // the half-edge in the other direction; none only beside an open hole
  u32* face_origin = nullptr;  // face before the transaction, or none
  u32 vertex_capacity = 0, face_capacity = 0;
  u32 vertex_count = 0, face_count = 0;      // slots in use, holes included
  u32 free_vertex = none, free_face = none;  // lists of holes, threaded through parents[0] and corner[3 f + 1]
};

constexpr u32 next_edge(u32 h) { return h % 3 == 2 ? h - 2 : h + 1; }
constexpr u32 previous_edge(u32 h) { return h % 3 == 0 ? h + 2 : h - 1; }
constexpr u32 face_of(u32 h) { return h / 3; }
// The index of the half-edge in its face, and of the corner at its tail.
constexpr u32 index_in_face(u32 h) { return h % 3; }

inline u32 tail(const Mesh& m, u32 h) { return m.corner[h]; }
inline u32 head(const Mesh& m, u32 h) { return m.corner[next_edge(h)]; }
// The corner of h's face across from h.
inline u32 apex(const Mesh& m, u32 h) { return m.corner[previous_edge(h)]; }
// The next half-edge with the same tail, counter-clockwise.
inline u32 rotate(const Mesh& m, u32 h) { return m.opposite[previous_edge(h)]; }

inline bool vertex_lives(const Mesh& m, u32 v) { return m.vertex_edge[v] != none; }
inline bool face_lives(const Mesh& m, u32 f) { return m.corner[3 * f] != none; }
// After a commit, for a face slot beyond the mesh and in use before: the new slot of the face, or none. The new slot
// may lie beyond the mesh, too, and lead further.
inline u32& face_moved_to(const Mesh& m, u32 f) { return m.corner[3 * f + 1]; }

// Is the vertex older than the transaction? A new one may have taken over the slot.
inline bool is_old(const Mesh& m, u32 v) { return m.vertex_origin[v].parents[1] == none; }

inline const Vec3& corner_position(const Mesh& m, u32 h) { return m.position[m.corner[h]]; }
inline Triangle triangle_of(const Mesh& m, const u32* v) {
  return {m.position[v[0]], m.position[v[1]], m.position[v[2]]};
}
inline Vec3 face_normal(const Mesh& m, u32 f) {
  return area_normal(corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2));
}

// Calls visit(h) for each half-edge with the tail of `first`, counter-clockwise from `first` on. Pre: a closed star.
template <class Visit>
inline void for_each_outgoing_from(const Mesh& m, u32 first, Visit visit) {
  u32 h = first;
  do {
    const u32 following = rotate(m, h);
    visit(h);
    h = following;
  } while (h != first);
}

template <class Visit>
inline void for_each_outgoing(const Mesh& m, u32 v, Visit visit) {
  for_each_outgoing_from(m, m.vertex_edge[v], visit);
}

// Calls visit(u) for the heads of the half-edges from v, in the same order. Pre: visit does not change the mesh.
template <class Visit>
inline void for_each_neighbour(const Mesh& m, u32 v, Visit visit) {
  const u32 first = m.vertex_edge[v];
  for (u32 h = first, u = head(m, first);;) {
    const u32 before = previous_edge(h), following = m.corner[before];
    h = m.opposite[before];
    visit(u);
    if (h == first) return;
    u = following;
  }
}

inline u32 valence(const Mesh& m, u32 v) {
  u32 n = 0;
  for_each_outgoing(m, v, [&](u32) { ++n; });
  return n;
}

// Has v more than so many faces? O(most).
inline bool has_more_faces(const Mesh& m, u32 v, u32 most) {
  const u32 first = m.vertex_edge[v];
  u32 h = first;
  for (u32 n = 0; n < most; ++n)
    if ((h = rotate(m, h)) == first) return false;
  return true;
}

// A vertex that all of some faces have, or none. Mostly O(1), since two or three faces have none in common.
u32 common_corner(const Mesh& m, Span<const u32> faces);

// The half-edge from a to b, or none. O(the lesser valence). Pre: closed stars.
u32 find_edge(const Mesh& m, u32 a, u32 b);

// The report of tpa_load on a mesh that is no closed oriented 2-manifold. Numbers as TPA_DEFECT_... of the header.
struct Defect {
  i32 kind = 0;
  u32 element = 0, other = 0;
};

// Fills opposite and vertex_edge from corner[0 .. 3 face_count - 1], and checks the mesh on the way. Overwrites
// `per_vertex`, of vertex_count + 1 entries, and `edges`, of 3 face_count. O(V), whatever the valences and the order of
// the triangles.
Defect connect(Mesh& m, u32* per_vertex, u32* edges);

}  // namespace tpa
