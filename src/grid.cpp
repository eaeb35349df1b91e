#include "grid.h"

#include "refit.h"

namespace tpa {

namespace {

constexpr u32 fewest_slots = 256;

// ---------------------------------------------------------------- changes

// Room for as many records as there are slots, and twice as many places.
[[gnu::cold]] void set_slots(Changes& c, u32 slots) {
  c.hash.slots = slots;
  set_places(c, 2 * slots);
  fill(c.hash, c.count);
}

// The record of f, made where there is none yet; none where there is no room.
u32 take_record(Changes& c, u32 f) {
  if (const u32 known = number_of(c, f); known != none) return known;
  if (c.count == c.capacity) return none;
  if (c.count == c.hash.slots) set_slots(c, 2 * c.count);
  const u32 record = add(c, f);
  c.hash.entry[record].box = empty_box;
  return record;
}

// ---------------------------------------------------------------- all

Clusters& loose_tree(const Grid& g) {
  if (!is_loose(*g.tree)) loosen(*g.tree, g.mesh->face_capacity);
  return *g.tree;
}

bool is_entered(const Grid& g, u32 f) {
  if (const u32 slot = slot_of(g.focus, f); slot != none) return is_entered(g.focus, slot);
  if (is_in_tree(loose_tree(g), f)) return true;
  const u32 record = number_of(g.changes, f);
  return record != none && !is_empty(g.changes.hash.entry[record].box);
}

// Where too many have found no place in the tree: another one, of all faces that are entered, as they are now. What is
// asked of the one before is noted where the places of the faces were.
[[gnu::cold]] void arrange_entered(Grid& g) {
  const Mesh& m = *g.mesh;
  Clusters& tree = *g.tree;
  for (u32 f = 0; f < m.face_count; ++f) tree.place[f] = is_entered(g, f) ? 1 : 0;
  arrange_some(tree, m);
  watch(g, m, tree);
}

FlatBox tree_box(const Frame& frame, const Box& box) {
  const auto corner = [](const f32* at) {
    return Vec3{static_cast<f64>(at[0]), static_cast<f64>(at[1]), static_cast<f64>(at[2])};
  };
  return flat_box(frame, corner(box.low), corner(box.high));
}

// A face enters behind the focus: the tree where it finds a place, else the hash. False where that has no room.
bool enter_behind(Grid& g, u32 f, const Box& box) {
  if (put_in_tree(loose_tree(g), f, tree_box(g.tree->frame, box))) return true;
  const u32 record = take_record(g.changes, f);
  if (record == none) return false;
  g.changes.hash.entry[record].box = box;
  // The first one tells how large cells have to be.
  if (g.changes.count == 1)
    fill(g.changes.hash, 1);
  else
    enter(g.changes.hash, record);
  return true;
}
void leave_behind(Grid& g, u32 f) {
  if (take_from_tree(loose_tree(g), f)) return;
  const u32 record = number_of(g.changes, f);
  leave(g.changes.hash, record);
  g.changes.hash.entry[record].box = empty_box;
}

}  // namespace

u32 most_changes(u64 vertices) {
  u32 n = 1024;
  while (n < vertices / 32) n *= 2;
  return n;
}

[[gnu::cold]] void watch(Grid& g, const Mesh& m, Clusters& tree) {
  g.mesh = &m;
  g.tree = &tree;
  clear(g.focus);
  g.changes.count = 0;
  set_slots(g.changes, fewest_slots);
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
  if (enter_behind(g, f, box)) return;
  arrange_entered(g);
  enter_behind(g, f, box);
}

void remove(Grid& g, u32 f) {
  if (const u32 slot = slot_of(g.focus, f); slot != none) {
    take_out(g.focus, slot);
    g.focus.state[slot] |= slot_changed;
    return;
  }
  leave_behind(g, f);
}

[[gnu::cold]] bool has_room(const Grid& g, Span<const u32> faces) {
  const Focus& focus = g.focus;
  u32 wanted = 0;
  for (u32 slot = 0; slot < focus.count; ++slot)
    wanted += (focus.state[slot] & slot_changed) != 0 && number_of(g.changes, focus.face[slot]) == none ? 1 : 0;
  for (u32 f : faces) {
    const u32 slot = slot_of(focus, f);
    const bool counted = slot != none && (focus.state[slot] & slot_changed) != 0;
    wanted += !counted && number_of(g.changes, f) == none ? 1 : 0;
  }
  return wanted <= g.changes.capacity - g.changes.count;
}

[[gnu::cold]] void end_focus(Grid& g) {
  Focus& focus = g.focus;
  for (u32 slot = 0; slot < focus.count; ++slot) {
    if ((focus.state[slot] & slot_changed) == 0) continue;
    const u32 f = focus.face[slot];
    if ((focus.state[slot] & slot_behind) != 0) leave_behind(g, f);
    if (!is_entered(focus, slot) || enter_behind(g, f, box_at(focus, slot))) continue;
    arrange_entered(g);
    return;
  }
  clear(focus);
}

GridShape shape_of(const Grid& g) { return {*g.tree, g.changes.hash, g.changes}; }

void resume(Grid& g, const Mesh& m, Clusters& tree, const GridShape& shape) {
  static_cast<TreeShape&>(tree) = shape.tree;
  static_cast<HashShape&>(g.changes.hash) = shape.hash;
  static_cast<FaceListShape&>(g.changes) = shape.changes;
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

void renumber(Grid& g, const Mesh& m, Span<const u32> faces) {
  for (u32 f : faces) {
    const bool entered = is_entered(g, f), lives = f < m.face_count;
    if (entered && !lives) remove(g, f);
    if (lives && !entered) insert(g, m, f);
  }
}

namespace {

using grid_detail::Asking;

u32 find_in_tree(const Clusters& tree, const FlatBox& query, const Asking& asking) {
  const ConstBoxLanes boxes = lanes_of(tree.box);
  const BroadBox wide = broad(query);
  u32 found = none;
  for_each_cluster_near(tree, query, 0, [&](u32 cluster) {
    const u32 last = is_loose(tree) ? tree.end[cluster] : tree.first[cluster + 1];
    return for_each_meeting(boxes, tree.first[cluster], last, wide, [&](u32 place) {
      if (!asking.ask(asking.data, face_at(tree, place))) return true;
      found = face_at(tree, place);
      return false;
    });
  });
  return found;
}

[[gnu::cold]] u32 find_in_hash(const Changes& c, const Box& query, const Asking& asking) {
  const u32 found = find_near(c.hash, query, [&](u32 record) { return asking.ask(asking.data, c.face[record]); });
  return found == none ? none : c.face[found];
}

u32 find_behind_focus(const Grid& g, const Box& query, Asking asking) {
  const u32 changed = g.changes.count == 0 ? none : find_in_hash(g.changes, query, asking);
  if (changed != none) return changed;
  return find_in_tree(*g.tree, tree_box(g.tree->frame, query), asking);
}

}  // namespace

namespace grid_detail {

u32 find(const Grid& g, const Box& query, Asking whom) {
  if (!is_open(g.focus)) return find_behind_focus(g, query, whom);
  const u32 near = find_focused(g.focus, broad(flat(query)), [&](u32 slot) {
    return whom.ask(whom.data, g.focus.face[slot]);
  });
  if (near != none || contains(g.focus.bounds, query)) return near;
  auto ask_others = [&](u32 f) { return slot_of(g.focus, f) == none && whom.ask(whom.data, f); };
  return find_behind_focus(g, query, asking(ask_others));
}

}  // namespace grid_detail

[[gnu::cold]] void focus_on(Grid& g, const Box& bounds) {
  if (contains(g.focus.bounds, bounds)) return;
  auto take_in = [&](u32 f) {
    const bool known = slot_of(g.focus, f) != none;
    return !known && !add(g.focus, f, face_box(*g.mesh, f), slot_behind);
  };
  g.focus.bounds = bounds;
  if (find_behind_focus(g, bounds, grid_detail::asking(take_in)) != none) end_focus(g);
}

}  // namespace tpa
