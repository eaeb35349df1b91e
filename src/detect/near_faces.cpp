// SPDX-License-Identifier: MIT
#include "detect/near_faces.h"

#include "detect/face_tree_edit.h"

namespace tpa {

namespace {

// Strays of dozens of events at once; fewer never make a tree crowded.
constexpr u32 fewest_crowding = 512;

FaceTree& loose_tree(NearFaces& g) {
  if (!is_loose(*g.tree)) loosen(*g.tree, g.mesh->face_capacity);
  return *g.tree;
}

Box tree_box(const Frame& frame, const Box& box) {
  const auto corner = [](const f32* at) {
    return Vec3{static_cast<f64>(at[0]), static_cast<f64>(at[1]), static_cast<f64>(at[2])};
  };
  return flat_box(frame, corner(box.low), corner(box.high));
}

// A face in a leaf of a hub ends its use if the face is not at the hub.
void keep_hub(FaceTree& tree, const Mesh& m, u32 leaf, u32 f) {
  const u32* v = m.corner + 3 * static_cast<size_t>(f);
  u32& hub = tree.hub[leaf];
  if (v[0] != hub && v[1] != hub && v[2] != hub) hub = none;
}

}  // namespace

bool is_crowded(const NearFaces& g) { return g.tree->strays > max_of(fewest_crowding, g.mesh->face_count / 32); }

void watch(NearFaces& g, const Mesh& m, FaceTree& tree) {
  g.mesh = &m;
  g.tree = &tree;
}

void resume(NearFaces& g, const Mesh& m, FaceTree& tree, const TreeShape& shape) {
  static_cast<TreeShape&>(tree) = shape;
  g.mesh = &m;
  g.tree = &tree;
}

void insert(NearFaces& g, const Mesh& m, u32 f) {
  constexpr u32 leaves_at_once = 16;  // looked at for a gap, in a unit of work
  const PutInTree put =
      put_in_tree(loose_tree(g), f, m.corner + 3 * static_cast<size_t>(f), tree_box(g.tree->frame, face_box(m, f)));
  spend(g.meter, 2 + put.looked / leaves_at_once);
  if (g.tree->has_hubs) keep_hub(*g.tree, m, put.leaf, f);
}

void remove(NearFaces& g, u32 f) { take_from_tree(loose_tree(g), f); }

void reenter(NearFaces& g, const Mesh& m, Span<const u32> faces) {
  for (u32 f : faces) insert(g, m, f);
}

void rollback(Edit& e, NearFaces& g) {
  const Mesh& m = e.mesh;
  for (u32 f = e.journal.face_count; f < m.face_count; ++f)
    if (is_in_tree(loose_tree(g), f)) remove(g, f);
  rollback(e);
  for (u32 f : e.journal.faces) insert(g, m, f);
  for (u32 v : e.journal.vertices) for_each_outgoing(m, v, [&](u32 h) { insert(g, m, face_of(h)); });
}

void remove_new(NearFaces& g, const Edit& e, const BitSet& faces) {
  for (u32 f : faces)
    if (f >= e.journal.face_count && is_in_tree(loose_tree(g), f)) remove(g, f);
}

void renumber(NearFaces& g, const Mesh& m, const BitSet& faces) {
  for (u32 f : faces) {
    g.tree->has_hubs = false;  // vertices have new numbers, too
    if (f < m.face_count || !is_in_tree(loose_tree(g), f)) continue;
    u32 to = f;
    while (to >= m.face_count) to = face_moved_to(m, to);
    rename_in_tree(*g.tree, f, to);
  }
}

namespace near_faces_detail {

namespace {

constexpr u32 passed_for_unit = 8;  // leaves and nodes

// A search, leaf by leaf.
struct Search {
  const FaceTree& tree;
  Box query;  // in tree units
  Asking whom;
  u32 found = none, leaves = 1, faces = 0, passed = 0;

  bool visit(u32 leaf) {
    ++leaves;
    const u32 last = is_loose(tree) ? tree.end[leaf] : tree.first[leaf + 1];
    const QuantizedBox box = byte_box(tree.byte_frame[leaf], query);
    return for_each_meeting(tree.box, tree.first[leaf], last, box, [&](u32 place) {
      ++faces;
      if (!whom.ask(whom.data, face_at(tree, place))) return true;
      found = face_at(tree, place);
      return false;
    });
  }
  u64 units() const { return u64{leaves} + faces + passed / passed_for_unit; }
};

struct SearchWithin {
  Search search;
  Entering entering;

  bool asks(u32 node, u32 hub) {
    ++search.passed;
    return entering.enters(entering.data, node_box(search.tree, node), hub);
  }
  bool enters(u32 node) { return asks(node, none); }
  bool visit(u32 leaf) {
    return !asks(leaf, search.tree.has_hubs ? search.tree.hub[leaf] : none) || search.visit(leaf);
  }
};

}  // namespace

u32 find(const NearFaces& g, const Box& query, const PassedOver& passed, Asking whom) {
  const FaceTree& tree = *g.tree;
  Search search{tree, tree_box(tree.frame, query), whom};
  for_each_leaf_near(tree, search.query, 0, [&](u32 leaf) {
    if (!tree.has_hubs || !passed.has(tree.hub[leaf])) return search.visit(leaf);
    ++search.passed;
    return true;
  });
  spend(g.meter, search.units());
  return search.found;
}

u32 find_within(const NearFaces& g, const Box& query, Entering entering, Asking whom) {
  SearchWithin within{{*g.tree, tree_box(g.tree->frame, query), whom}, entering};
  search_leaves(*g.tree, within.search.query, within);
  spend(g.meter, within.search.units());
  return within.search.found;
}

}  // namespace near_faces_detail

}  // namespace tpa
