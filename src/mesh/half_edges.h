// half_edges: a closed triangle mesh as a half-edge table, and the questions one asks of it.
// Half-edge h = 3 * face + i runs from corner i to corner i + 1 of its face; the face lies on its left.
#pragma once

#include "base/vec3.h"

namespace tpa {

// Where a vertex came from, in ids before the transaction. An old vertex: {id, none}, weight 1.
struct VertexOrigin {
  u32 parents[2];
  f32 weight;
};

struct Mesh {
  Vec3* position = nullptr;
  u32* vertex_edge = nullptr;  // a half-edge that leaves the vertex; none: the slot is a hole
  VertexOrigin* vertex_origin = nullptr;
  u32* corner = nullptr;       // vertex at the start of the half-edge; corner[3 f] == none: face slot f is a hole
  u32* opposite = nullptr;     // the half-edge that runs the other way; none only while a hole is being filled
  u32* face_origin = nullptr;  // face before the transaction, or none
  u32 vertex_capacity = 0, face_capacity = 0;
  u32 vertex_count = 0, face_count = 0;      // slots in use, holes included
  u32 free_vertex = none, free_face = none;  // lists of holes, threaded through parents[0] and corner[3 f + 1]
};

// By the inverse of 3 modulo 2^32, which takes its multiples to the lowest third: compilers divide where code is to be
// small, which takes several times as long. Without a branch: at which corner a walk arrives is as good as random.
constexpr u32 is_multiple_of_3(u32 n) { return n * 0xAAAAAAABu <= 0x55555555u ? 1 : 0; }
constexpr u32 next_edge(u32 h) { return h + 1 - 3 * is_multiple_of_3(h + 1); }
constexpr u32 previous_edge(u32 h) { return h - 1 + 3 * is_multiple_of_3(h); }
constexpr u32 face_of(u32 h) {
  if constexpr (sizeof(size_t) == 8) return static_cast<u32>(u64{h} * 0xAAAAAAAB >> 33);
  return h / 3;
}
// The index of the half-edge, and of the corner that it leaves, in its face.
constexpr u32 index_in_face(u32 h) { return h - 3 * face_of(h); }

inline u32 tail(const Mesh& m, u32 h) { return m.corner[h]; }
inline u32 head(const Mesh& m, u32 h) { return m.corner[next_edge(h)]; }
// The vertex of h's face that is not on h.
inline u32 apex(const Mesh& m, u32 h) { return m.corner[previous_edge(h)]; }
// The next half-edge that leaves the same vertex, counter-clockwise.
inline u32 rotate(const Mesh& m, u32 h) { return m.opposite[previous_edge(h)]; }

inline bool vertex_lives(const Mesh& m, u32 v) { return m.vertex_edge[v] != none; }
inline bool face_lives(const Mesh& m, u32 f) { return m.corner[3 * f] != none; }
// After a commit, of a face slot beyond the mesh that was in use before: where its face went, perhaps by way of others,
// or none.
inline u32& face_moved_to(const Mesh& m, u32 f) { return m.corner[3 * f + 1]; }

// Was the vertex there before the transaction? A slot may have been taken over by a new one.
inline bool is_old(const Mesh& m, u32 v) { return m.vertex_origin[v].parents[1] == none; }

inline const Vec3& corner_position(const Mesh& m, u32 h) { return m.position[m.corner[h]]; }
// Of the triangle with these vertices.
inline Triangle triangle_of(const Mesh& m, const u32* v) {
  return {m.position[v[0]], m.position[v[1]], m.position[v[2]]};
}
inline Vec3 face_normal(const Mesh& m, u32 f) {
  return area_normal(corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2));
}

// Calls visit(h) for each half-edge that leaves the vertex that `first` leaves, counter-clockwise from there. The star
// must be closed.
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

// Calls visit(u) for the ends of these half-edges, in the same order; visit must not change the mesh.
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

// The half-edge from a to b, or none.
u32 find_edge(const Mesh& m, u32 a, u32 b);

// What tpa_load reports of a mesh that is no closed oriented 2-manifold. Numbers as TPA_DEFECT_... of the header.
struct Defect {
  i32 kind = 0;
  u32 element = 0, other = 0;
};

// Fills opposite and vertex_edge from corner[0 .. 3 face_count - 1], and checks everything on the way. `head_slot`
// has vertex_count + 1 entries and `edges` 3 face_count, both overwritten. O(V), independent of the triangle order.
Defect connect(Mesh& m, u32* head_slot, u32* edges);

}  // namespace tpa
