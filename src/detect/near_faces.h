// near_faces: which faces lie near a box, while the mesh is edited? The tree in which detection arranged all faces
// follows their edits.
#pragma once

#include "detect/face_tree.h"
#include "geometry/box.h"
#include "mesh/journal.h"

namespace tpa {

inline Box face_box(const Mesh& m, u32 f) {
  return box_of(corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2));
}

struct NearFaces {
  const Mesh* mesh = nullptr;
  FaceTree* tree = nullptr;  // none: there is no near_faces
};

// All faces are as in the tree, which belongs to the near_faces from here on. O(1).
void watch(NearFaces& g, const Mesh& m, FaceTree& tree);
// A near_faces outlasts a call: the shape of its tree, and the arrays.
void resume(NearFaces& g, const Mesh& m, FaceTree& tree, const TreeShape& shape);
// Have so many faces come to lie far from where the tree has them that it is better to arrange all anew?
bool is_crowded(const NearFaces& g);
// Brings entered faces up to date that moved.
void reenter(NearFaces& g, const Mesh& m, Span<const u32> faces);
// rollback(), of a mesh whose faces have entered as they are, or as they were when the transaction began.
void rollback(Edit& e, NearFaces& g);
// After a commit: some of these have another number.
void renumber(NearFaces& g, const Mesh& m, const BitSet& faces);

// A face enters as it is now, also one that is entered. Expected O(log V); once O(V).
void insert(NearFaces& g, const Mesh& m, u32 f);
// Pre: it has entered.
void remove(NearFaces& g, u32 f);

namespace near_faces_detail {
// Whom to ask about a face: a function and what it is called with, so that there is one search for all.
struct Asking {
  bool (*ask)(void* data, u32 f);
  void* data;
};
template <class Ask>
Asking asking(Ask& ask) {
  return {[](void* data, u32 f) { return (*static_cast<Ask*>(data))(f); }, &ask};
}
u32 find(const NearFaces& g, const Box& query, Asking asking);
}  // namespace near_faces_detail

// Asks hit(f) exactly once for each entered face f with want(f) whose box meets the query, until one answers true;
// returns that face, or none. Faces whose boxes nearly meet the query may be asked about as well. Expected O(log V +
// faces asked) for queries no smaller than about the size of the faces.
template <class Want, class Hit>
inline u32 find_near(const NearFaces& g, const Box& query, Want want, Hit hit) {
  auto ask = [&](u32 f) { return want(f) && hit(f); };
  return near_faces_detail::find(g, query, near_faces_detail::asking(ask));
}

// Calls visit(f) exactly once for each entered face whose box meets the query, and perhaps for some that nearly do.
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
