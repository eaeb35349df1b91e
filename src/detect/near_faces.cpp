#include "detect/near_faces.h"

#include "detect/face_tree_edit.h"

namespace tpa {

namespace {

// Enough for dozens of events at once.
constexpr u32 fewest_crowding = 512;

Clusters& loose_tree(Grid& g) {
  if (!is_loose(*g.tree)) loosen(*g.tree, g.mesh->face_capacity);
  return *g.tree;
}

FlatBox tree_box(const Frame& frame, const Box& box) {
  const auto corner = [](const f32* at) {
    return Vec3{static_cast<f64>(at[0]), static_cast<f64>(at[1]), static_cast<f64>(at[2])};
  };
  return flat_box(frame, corner(box.low), corner(box.high));
}

}  // namespace

bool is_crowded(const Grid& g) { return g.tree->strays > max_of(fewest_crowding, g.mesh->face_count / 128); }

void watch(Grid& g, const Mesh& m, Clusters& tree) {
  g.mesh = &m;
  g.tree = &tree;
}

void resume(Grid& g, const Mesh& m, Clusters& tree, const TreeShape& shape) {
  static_cast<TreeShape&>(tree) = shape;
  g.mesh = &m;
  g.tree = &tree;
}

void insert(Grid& g, const Mesh& m, u32 f) {
  put_in_tree(loose_tree(g), f, tree_box(g.tree->frame, face_box(m, f)));
}

void remove(Grid& g, u32 f) { take_from_tree(loose_tree(g), f); }

void reenter(Grid& g, const Mesh& m, Span<const u32> faces) {
  for (u32 f : faces) insert(g, m, f);
}

void rollback(Edit& e, Grid& g) {
  const Mesh& m = e.mesh;
  for (u32 f = e.journal.face_count; f < m.face_count; ++f)
    if (is_in_tree(loose_tree(g), f)) remove(g, f);
  rollback(e);
  for (u32 f : e.journal.faces) insert(g, m, f);
  for (u32 v : e.journal.vertices) for_each_outgoing(m, v, [&](u32 h) { insert(g, m, face_of(h)); });
}

void renumber(Grid& g, const Mesh& m, const IdSet& faces) {
  for (u32 f : faces) {
    if (f < m.face_count || !is_in_tree(loose_tree(g), f)) continue;
    u32 to = f;
    while (to >= m.face_count) to = face_moved_to(m, to);
    rename_in_tree(*g.tree, f, to);
  }
}

namespace grid_detail {

u32 find(const Grid& g, const Box& query, Asking whom) {
  const Clusters& tree = *g.tree;
  const FlatBox flat_query = tree_box(tree.frame, query);
  u32 found = none;
  for_each_cluster_near(tree, flat_query, 0, [&](u32 cluster) {
    const u32 last = is_loose(tree) ? tree.end[cluster] : tree.first[cluster + 1];
    const ByteBox box = byte_box(tree.byte_frame[cluster], flat_query);
    return for_each_meeting(tree.box, tree.first[cluster], last, box, [&](u32 place) {
      if (!whom.ask(whom.data, face_at(tree, place))) return true;
      found = face_at(tree, place);
      return false;
    });
  });
  return found;
}

}  // namespace grid_detail

}  // namespace tpa
