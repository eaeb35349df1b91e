// journal: edits of the mesh that can be taken back (docs/architecture.md: transaction and rollback).
// The first edit of a vertex or face within a transaction saves its record in a shadow array of full size, so the
// journal cannot run out, and both rollback and commit cost what the edits cost. Opposites are not saved, since the
// corners tell them: between two vertices there is one edge at most. A half-edge that is about to lose its opposite
// saves the face beyond it too, so whichever face has not been saved is linked as before to one that was, and that one
// to it; rollback finds the others again.
#pragma once

#include "base/bit_set.h"
#include "mesh/half_edges.h"

namespace tpa {

// What the mesh keeps in arrays of their own is saved as one: what is edited is far apart.
struct OldVertex {
  VertexOrigin origin;
  u32 edge;
};
struct OldFace {
  u32 corner[3], origin;
};

struct Journal {
  Vec3* position = nullptr;  // shadow records, indexed like the mesh
  OldVertex* vertex = nullptr;
  OldFace* face = nullptr;
  // Saved, or made, in this transaction; between transactions: at least those with entries in the last maps.
  BitSet vertices, faces;
  u32 vertex_count = 0, face_count = 0;  // at the start of the transaction
};

// The mesh with its journal: what every room above edits.
struct Edit {
  Mesh mesh;
  Journal journal;
};

// Starts a transaction and resets the maps (origins) to "everything is itself".
void begin(Edit& e);
// Everything back as it was at begin. Expected O(edits).
void rollback(Edit& e);
// Closes the holes by moving the last elements into them, and fills old_to_new[0 .. journal.vertex_count - 1] where
// it is not the identity; entries touched by the commit before must have been reset (see reset_map). `label`, a number
// for each vertex, goes with it; the slot that it leaves, beyond the mesh, says where it went.
void commit(Edit& e, u32* old_to_new, u32* label);
// After commit(): of what was touched, only what the maps are not the identity for has to be known to the next
// transaction.
void forget_unmapped(Edit& e, const u32* old_to_new);
// Makes old_to_new the identity again where the last commit changed it. Call at commit time, before commit().
void reset_map(const Edit& e, u32* old_to_new, u32 old_count);

void save_vertex(Edit& e, u32 v);
inline void touch_vertex(Edit& e, u32 v) {
  if (!e.journal.vertices.contains(v)) save_vertex(e, v);
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
// A hole opens beside h.
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
inline bool has_moved(const Edit& e, u32 v) {
  return e.journal.vertices.contains(v) && !(e.journal.position[v] == e.mesh.position[v]);
}

// New elements; none where the capacity is used up. A new vertex has no edge yet, a new face no opposites.
u32 new_vertex(Edit& e, const Vec3& p, const VertexOrigin& origin);
u32 new_face(Edit& e, u32 a, u32 b, u32 c, u32 origin);
void delete_vertex(Edit& e, u32 v);
void delete_face(Edit& e, u32 f);

// Origin of a new vertex between a and b, at (1 - t) a + t b: the two old vertices that weigh most in it.
VertexOrigin blend_origins(const Mesh& m, u32 a, u32 b, f64 t);

}  // namespace tpa
