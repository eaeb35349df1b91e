// SPDX-License-Identifier: MIT
// journal: edits of the mesh, with rollback (docs/architecture.md, Transactions). The first edit of a vertex or face in
// a transaction saves its record in a shadow array of full length. So the journal cannot run out, and
// rollback and commit cost as much as the edits. Opposites are not saved: any two vertices share at most one edge, so
// corners alone tell which half-edges are opposite. Before a half-edge loses its opposite, both faces are saved. So
// faces not saved keep all of their links, in both directions, and rollback pairs the half-edges of saved faces again.
#pragma once

#include "base/bit_set.h"
#include "mesh/half_edges.h"

namespace tpa {

// Two arrays of the mesh in a single record, since edited vertices lie far apart in memory.
struct OldVertex {
  VertexOrigin origin;
  u32 edge;
};
struct OldFace {
  u32 corner[3], origin;
};

// Part of a transaction that is taken back alone: an owner claims the elements that it edits (islands/island.h). Each
// element has one owner at most.
struct Claims {
  u32 *vertex_owner = nullptr, *face_owner = nullptr;  // per element; none, and everywhere so between transactions
  BitSet vertices, faces;                              // edited by the present owner
  u32 owner = none;                                    // none: edits belong to the whole transaction
  u32 met = none;                                      // another owner of an edited element, the first one met

  void note_owner(u32 other) {
    if (other != none && other != owner && met == none) met = other;
  }
  void claim(BitSet& set, u32* owner_of, u32 i) {
    if (!set.add(i)) return;
    if (owner_of[i] == none) owner_of[i] = owner;
    note_owner(owner_of[i]);
  }
  void claim_vertex(u32 v) { claim(vertices, vertex_owner, v); }
  void claim_face(u32 f) { claim(faces, face_owner, f); }
};

struct Journal {
  Vec3* position = nullptr;  // shadow records, indexed like the mesh
  OldVertex* vertex = nullptr;
  OldFace* face = nullptr;
  // Vertices and faces saved or made in this transaction. Between transactions: at least all with entries in the last
  // maps other than the identity.
  BitSet vertices, faces;
  u32 vertex_count = 0, face_count = 0;     // at the start of the transaction
  u32 spare_vertices = 0, spare_faces = 0;  // slots at the end of the mesh's capacity that are not to be used
  // Holes from here on in the lists of the mesh, not to be used either: each owner uses holes of its own only, so the
  // order of numbers within its part does not depend on others.
  u32 resting_vertex = none, resting_face = none;
  Claims claims;
};

// The mesh with its journal, for every room that edits.
struct Edit {
  Mesh mesh;
  Journal journal;
};

// Starts a transaction, and makes every vertex and face its own origin. O(entries of the last maps other than the
// identity).
void begin(Edit& e);
// Restores the mesh as it was at begin(). Expected O(edits).
void rollback(Edit& e);
// The slots and holes of a mesh at some moment of a transaction.
struct Slots {
  u32 vertices, faces, free_vertex, free_face;
};
inline Slots slots_of(const Mesh& m) { return {m.vertex_count, m.face_count, m.free_vertex, m.free_face}; }

// Takes back what the owners of all claimed elements have edited since `before`: old elements are as before the
// transaction, new ones are gone. The claims stay. `waiting`, per vertex, is `none` before and after. Expected
// O(claims).
void take_back_claims(Edit& e, const Slots& before, u32* waiting);
// Closes holes in the numbering by moving the last elements there. Writes all entries of
// old_to_new[0 .. journal.vertex_count - 1] other than the identity. Pre: reset_map() has reset the entries of the
// commit before. The label of a vertex moves along; the old slot, now beyond the mesh, gets the new number of the
// vertex as label. Expected O(edits).
void commit(Edit& e, u32* old_to_new, u32* label);
// After commit(): makes the sets those of the slots of the mesh with another position, or with other corners, than
// before, and of slots that were not there.
void note_changes(const Edit& e, BitSet vertices, BitSet faces);
// After commit(): removes from the journal's sets all vertices and faces with the identity as map entry. The next
// begin() relies on the sets.
void forget_unmapped(Edit& e, const u32* old_to_new);
// Adds all others to the sets, between transactions. Pre: the sets are empty. O(V).
void note_mapped(Edit& e, const u32* old_to_new);
// Resets the entries of old_to_new written by the last commit. Call just before commit().
void reset_map(const Edit& e, u32* old_to_new, u32 old_count);

// Save a record before its first edit. All functions below that edit do so on their own.
void save_vertex(Edit& e, u32 v);
inline void touch_vertex(Edit& e, u32 v) {
  if (!e.journal.vertices.contains(v)) save_vertex(e, v);
  if (e.journal.claims.owner != none) e.journal.claims.claim_vertex(v);
}
void touch_face(Edit& e, u32 f);

inline void set_position(Edit& e, u32 v, const Vec3& p) {
  touch_vertex(e, v);
  e.mesh.position[v] = p;
}
inline void set_vertex_edge(Edit& e, u32 v, u32 h) {
  touch_vertex(e, v);
  e.mesh.vertex_edge[v] = h;
}
inline void set_corner(Edit& e, u32 h, u32 v) {
  touch_face(e, face_of(h));
  e.mesh.corner[h] = v;
}
inline void touch_both_sides(Edit& e, u32 h) {
  touch_face(e, face_of(h));
  if (e.mesh.opposite[h] != none) touch_face(e, face_of(e.mesh.opposite[h]));
}
// Opens a hole beside h. The half-edge on the other side keeps its link to h.
inline void unlink(Edit& e, u32 h) {
  touch_both_sides(e, h);
  e.mesh.opposite[h] = none;
}
// Makes g and h each other's opposite.
inline void link(Edit& e, u32 g, u32 h) {
  touch_both_sides(e, g);
  touch_both_sides(e, h);
  e.mesh.opposite[g] = h;
  e.mesh.opposite[h] = g;
}

inline const Vec3& old_position(const Edit& e, u32 v) {
  const Vec3* const at[] = {e.mesh.position, e.journal.position};
  return at[e.journal.vertices.contains(v)][v];
}
// Of a face of the mesh before the transaction.
inline const u32* old_corners(const Edit& e, u32 f) {
  return e.journal.faces.contains(f) ? e.journal.face[f].corner : e.mesh.corner + 3 * static_cast<size_t>(f);
}
inline bool has_moved(const Edit& e, u32 v) {
  return e.journal.vertices.contains(v) && !(e.journal.position[v] == e.mesh.position[v]);
}

// A new vertex has no edge yet, and a new face no opposites. Both return none if the capacity is used up,
// but for the spare slots.
u32 new_vertex(Edit& e, const Vec3& p, const VertexOrigin& origin);
u32 new_face(Edit& e, u32 a, u32 b, u32 c, u32 origin);
// From now on only so many slots of the mesh are to be used.
void allow_slots(Edit& e, u64 vertices, u64 faces);
// Can so many vertices be made? O(count).
bool has_free_vertices(const Edit& e, u32 count);
void delete_vertex(Edit& e, u32 v);
void delete_face(Edit& e, u32 f);

// The origin of a new vertex at (1 - t) a + t b: the two old vertices with the largest weights. 0 <= t <= 1.
VertexOrigin blend_origins(const Mesh& m, u32 a, u32 b, f64 t);

}  // namespace tpa
