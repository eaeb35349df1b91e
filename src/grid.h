// grid: which faces lie near a box, while the mesh is edited? Faces that are as they were when detection arranged them
// are found in its tree; those that were made or changed since, in a spatial hash. Where most of them change, all are
// hashed. What is near an event is taken out of all that while it lasts, into the focus.
#pragma once

#include "box_hash.h"
#include "clusters.h"
#include "focus.h"
#include "mesh.h"

namespace tpa {

inline Box face_box(const Mesh& m, u32 f) {
  return box_of(corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2));
}

// Faces that are not as the tree has them: a record for each. Twice as many places as slots of the hash.
struct Changes : FaceList {
  BoxHash hash;  // by record; empty boxes: faces that are in the tree only
};

struct Grid {
  const Mesh* mesh = nullptr;
  const Clusters* tree = nullptr;  // none: all faces are hashed
  Changes changes;
  BoxHash all;                     // by face
  Focus focus;
};

// How many changed faces a grid for so many vertices takes before it hashes all: enough for dozens of events at once.
u32 most_changes(u64 vertices);

// Hashes all living faces. O(V).
void rebuild(Grid& g, const Mesh& m);
// All faces are as in the tree, which stays as it is from here on, until the grid is rebuilt. O(1).
void watch(Grid& g, const Mesh& m, const Clusters& tree);
// A grid with a tree outlasts a call: this, and its arrays.
struct GridShape {
  TreeShape tree;
  HashShape hash;
  FaceListShape changes;
};
GridShape shape_of(const Grid& g);
void resume(Grid& g, const Mesh& m, Clusters& tree, const GridShape& shape);
// From here on, faces whose boxes meet `bounds` are found sooner: those few are kept in the focus, and all changes with
// them, until it ends. Without a tree, or where it would hold more than `most` faces, nothing is gained and nothing done.
void focus_on(Grid& g, const Box& bounds, u32 most);
void end_focus(Grid& g);
// May these change without all being hashed?
bool has_room(const Grid& g, Span<const u32> faces);
// Brings faces up to date that moved, or after a commit have another number or are gone. There is a tree, and room.
void reenter(Grid& g, const Mesh& m, Span<const u32> faces);

// Faces enter as they are now, and leave as they entered. Expected O(1); once O(V), where there are too many changes.
void insert(Grid& g, const Mesh& m, u32 f);
void remove(Grid& g, u32 f);

namespace grid_detail {
// Whom to ask about a face: a function and what it is called with, so that there is one search for all.
struct Asking {
  bool (*ask)(void* data, u32 f);
  void* data;
};
template <class Ask>
Asking asking(Ask& ask) {
  return {[](void* data, u32 f) { return (*static_cast<Ask*>(data))(f); }, &ask};
}
u32 find(const Grid& g, const Box& query, Asking asking);
}  // namespace grid_detail

// Asks hit(f) exactly once for each entered face f with want(f) whose box meets the query, until one answers true;
// returns that face, or none. Faces whose boxes nearly meet the query may be asked about as well. Expected O(log V +
// faces asked) for queries of about the size of the faces.
template <class Want, class Hit>
inline u32 find_near(const Grid& g, const Box& query, Want want, Hit hit) {
  auto ask = [&](u32 f) { return want(f) && hit(f); };
  return grid_detail::find(g, query, grid_detail::asking(ask));
}

// Calls visit(f) exactly once for each entered face whose box meets the query, and perhaps for some that nearly do.
template <class Visit>
inline void for_each_near(const Grid& g, const Box& query, Visit visit) {
  find_near(g, query, [](u32) { return true; }, [&](u32 f) {
    visit(f);
    return false;
  });
}

}  // namespace tpa
