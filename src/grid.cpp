#include "grid.h"

#include "refit.h"

namespace tpa {

namespace {

// Enough for dozens of events at once.
constexpr u32 fewest_crowding = 512;

Clusters& loose_tree(const Grid& g) {
  if (!is_loose(*g.tree)) loosen(*g.tree, g.mesh->face_capacity);
  return *g.tree;
}

bool is_entered(const Grid& g, u32 f) {
  const u32 slot = slot_of(g.focus, f);
  return slot != none ? is_entered(g.focus, slot) : is_in_tree(loose_tree(g), f);
}

FlatBox tree_box(const Frame& frame, const Box& box) {
  const auto corner = [](const f32* at) {
    return Vec3{static_cast<f64>(at[0]), static_cast<f64>(at[1]), static_cast<f64>(at[2])};
  };
  return flat_box(frame, corner(box.low), corner(box.high));
}

void enter_behind(Grid& g, u32 f, const Box& box) {
  put_in_tree(loose_tree(g), f, tree_box(g.tree->frame, box));
}

}  // namespace

bool is_crowded(const Grid& g) { return g.tree->strays > max_of(fewest_crowding, g.mesh->face_count / 128); }

void watch(Grid& g, const Mesh& m, Clusters& tree) {
  g.mesh = &m;
  g.tree = &tree;
  clear(g.focus);
}

void insert(Grid& g, const Mesh& m, u32 f) {
  const Box box = face_box(m, f);
  if (is_open(g.focus)) {
    const u32 slot = slot_of(g.focus, f);
    if (slot != none) {
      set_box(g.focus, slot, box);
      g.focus.state[slot] |= slot_changed;
      return;
    }
    if (add(g.focus, f, box, slot_changed)) return;
    end_focus(g);
  }
  enter_behind(g, f, box);
}

void remove(Grid& g, u32 f) {
  if (const u32 slot = slot_of(g.focus, f); slot != none) {
    take_out(g.focus, slot);
    g.focus.state[slot] |= slot_changed;
    return;
  }
  take_from_tree(loose_tree(g), f);
}

[[gnu::cold]] void end_focus(Grid& g) {
  Focus& focus = g.focus;
  for (u32 slot = 0; slot < focus.count; ++slot) {
    if ((focus.state[slot] & slot_changed) == 0) continue;
    const u32 f = focus.face[slot];
    if (is_entered(focus, slot))
      enter_behind(g, f, box_at(focus, slot));
    else if ((focus.state[slot] & slot_behind) != 0)
      take_from_tree(loose_tree(g), f);
  }
  clear(focus);
}

void resume(Grid& g, const Mesh& m, Clusters& tree, const TreeShape& shape) {
  static_cast<TreeShape&>(tree) = shape;
  g.mesh = &m;
  g.tree = &tree;
}

void reenter(Grid& g, const Mesh& m, Span<const u32> faces) {
  for (u32 f : faces) {
    // There it may keep its place.
    const bool in_tree = !is_open(g.focus) && is_in_tree(loose_tree(g), f);
    if (!in_tree && is_entered(g, f)) remove(g, f);
    insert(g, m, f);
  }
}

void renumber(Grid& g, const Mesh& m, const IdSet& faces) {
  end_focus(g);
  for (u32 f : faces) {
    if (f < m.face_count || !is_in_tree(loose_tree(g), f)) continue;
    u32 to = f;
    while (to >= m.face_count) to = face_moved_to(m, to);
    rename_in_tree(*g.tree, f, to);
  }
}

namespace {

using grid_detail::Asking;

u32 find_in_tree(const Grid& g, const Box& query, const Asking& asking) {
  const Clusters& tree = *g.tree;
  const FlatBox flat_query = tree_box(tree.frame, query);
  u32 found = none;
  for_each_cluster_near(tree, flat_query, 0, [&](u32 cluster) {
    const u32 last = is_loose(tree) ? tree.end[cluster] : tree.first[cluster + 1];
    const ByteBox box = byte_box(tree.byte_frame[cluster], flat_query);
    return for_each_meeting(tree.box, tree.first[cluster], last, box, [&](u32 place) {
      if (!asking.ask(asking.data, face_at(tree, place))) return true;
      found = face_at(tree, place);
      return false;
    });
  });
  return found;
}

}  // namespace

namespace grid_detail {

u32 find(const Grid& g, const Box& query, Asking whom) {
  if (!is_open(g.focus)) return find_in_tree(g, query, whom);
  const u32 near = find_focused(g.focus, broad(flat(query)), [&](u32 slot) {
    return whom.ask(whom.data, g.focus.face[slot]);
  });
  if (near != none || contains(g.focus.bounds, query)) return near;
  auto ask_others = [&](u32 f) { return slot_of(g.focus, f) == none && whom.ask(whom.data, f); };
  return find_in_tree(g, query, asking(ask_others));
}

}  // namespace grid_detail

[[gnu::cold]] void focus_on(Grid& g, const Box& bounds) {
  if (contains(g.focus.bounds, bounds)) return;
  const bool fresh = !is_open(g.focus);
  auto ask = [&](u32 f) {
    const bool known = !fresh && slot_of(g.focus, f) != none;
    return !known && !take_in(g.focus, f, face_box(*g.mesh, f), slot_behind);
  };
  g.focus.bounds = bounds;
  if (find_in_tree(g, bounds, grid_detail::asking(ask)) != none)
    end_focus(g);
  else
    bound_all(g.focus);
}

}  // namespace tpa
