// SPDX-License-Identifier: MIT
// near_faces: the faces near a box, while the mesh is edited. Complete detection (section 3) arranges all faces in a
// face tree; edits keep the tree up to date from then on.
#pragma once

#include "detect/face_tree.h"
#include "geometry/box.h"
#include "mesh/journal.h"

namespace tpa {

inline Box face_box(const Mesh& m, u32 f) {
  return box_of(corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2));
}

struct HubStars;

struct NearFaces {
  const Mesh* mesh = nullptr;
  FaceTree* tree = nullptr;  // nullptr: not watched yet
  Meter* meter = nullptr;    // of the call: searches and edits count, and so do those who search for long
  HubStars* hubs = nullptr;  // while operations go on that keep them up to date
};

// Begins with an arranged tree; all faces are as in the mesh, and only NearFaces edits the tree from here on. O(1).
void watch(NearFaces& g, const Mesh& m, FaceTree& tree);
// Goes on after another call of the library, with the arrays of the tree in place and the shape of the tree then. O(1).
void resume(NearFaces& g, const Mesh& m, FaceTree& tree, const TreeShape& shape);
// Have so many faces moved far from their leaves that arranging all faces anew pays?
bool is_crowded(const NearFaces& g);
// Enters moved faces.
void reenter(NearFaces& g, const Mesh& m, Span<const u32> faces);
// Rolls the edit back, and the entered faces with it. Pre: each face has entered, with its present box or
// the box at the begin of the transaction.
void rollback(Edit& e, NearFaces& g);
// Removes the entered ones of the faces that the transaction has made, among `faces`.
void remove_new(NearFaces& g, const Edit& e, const BitSet& faces);
// Follows the new numbers of a commit, for faces among `faces`.
void renumber(NearFaces& g, const Mesh& m, const BitSet& faces);

// Enters a face with its present box, or updates an entered face. Expected O(log V); the first call is O(V).
void insert(NearFaces& g, const Mesh& m, u32 f);
// Pre: the face has entered. O(1).
void remove(NearFaces& g, u32 f);

// A search passes over leaves whose faces all have one of these vertices, if the caller knows enough of such faces.
struct PassedOver {
  u32 hub[3] = {none - 1, none - 1, none - 1};  // no vertices
  bool has(u32 v) const { return v == hub[0] || v == hub[1] || v == hub[2]; }
};

namespace near_faces_detail {
// A function to call for each face, with its data: no template, so that all searches share one function.
struct Asking {
  bool (*ask)(void* data, u32 f);
  void* data;
};
template <class Ask>
Asking asking(Ask& ask) {
  return {[](void* data, u32 f) { return (*static_cast<Ask*>(data))(f); }, &ask};
}
u32 find(const NearFaces& g, const Box& query, const PassedOver& passed, Asking asking);

// A function to call for each node and leaf, with its data.
struct Entering {
  bool (*enters)(void* data, const Box& box, u32 hub);
  void* data;
};
u32 find_within(const NearFaces& g, const Box& query, Entering entering, Asking asking);
}  // namespace near_faces_detail

// Asks hit(f) exactly once for each entered face f with want(f) and a box that meets the query, until an answer is
// true. Returns the face of the answer, or none. Asks for some faces with boxes nearly meeting the query as well.
// Expected O(log V + faces asked) for queries about as large as faces, or larger.
template <class Want, class Hit>
inline u32 find_near(const NearFaces& g, const Box& query, Want want, Hit hit, const PassedOver& passed = {}) {
  auto ask = [&](u32 f) { return want(f) && hit(f); };
  return near_faces_detail::find(g, query, passed, near_faces_detail::asking(ask));
}

// As find_near() where boxes say too little: enters(box, hub) is asked before the faces in a box, in tree units. All of
// the faces have the corner `hub`, if not none.
template <class Enters, class Hit>
inline u32 find_near_within(const NearFaces& g, const Box& query, Enters enters, Hit hit) {
  const auto call = [](void* data, const Box& box, u32 hub) { return (*static_cast<Enters*>(data))(box, hub); };
  return near_faces_detail::find_within(g, query, {call, &enters}, near_faces_detail::asking(hit));
}

// Calls visit(f) exactly once for each entered face with a box that meets the query, and for some with boxes nearly
// meeting the query.
template <class Visit>
inline void for_each_near(const NearFaces& g, const Box& query, Visit visit) {
  find_near(
      g, query, [](u32) { return true; },
      [&](u32 f) {
        visit(f);
        return false;
      });
}

}  // namespace tpa
