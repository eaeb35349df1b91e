#include "grid.h"

#include <string.h>

namespace tpa {

namespace {

constexpr u32 fewest_slots = 256;

// ---------------------------------------------------------------- changes

// Knuth's multiplicative hashing (The Art of Computer Programming, 6.4): 2^32 over the golden ratio.
u32 place_of(const Changes& c, u32 f) { return static_cast<u32>(u64{f * 2654435769u} * c.places >> 32); }

u32 find_record(const Changes& c, u32 f) {
  for (u32 at = place_of(c, f);; at = (at + 1) & (c.places - 1)) {
    const u32 record = c.place[at];
    if (record == none || c.face[record] == f) return record;
  }
}

void note_place(Changes& c, u32 record) {
  u32 at = place_of(c, c.face[record]);
  while (c.place[at] != none) at = (at + 1) & (c.places - 1);
  c.place[at] = record;
}

// Room for as many records as there are slots, and twice as many places.
void set_slots(Changes& c, u32 slots) {
  c.hash.slots = slots;
  c.places = 2 * slots;
  memset(c.place, 0xFF, static_cast<size_t>(c.places) * sizeof(u32));
  for (u32 i = 0; i < c.count; ++i) note_place(c, i);
  fill(c.hash, c.count);
}

// The record of f, made where there is none yet; none where there is no room.
u32 take_record(Changes& c, u32 f) {
  if (const u32 known = find_record(c, f); known != none) return known;
  if (c.count == c.capacity) return none;
  if (c.count == c.hash.slots) set_slots(c, 2 * c.count);
  const u32 record = c.count++;
  c.face[record] = f;
  c.hash.entry[record].box = empty_box;
  note_place(c, record);
  return record;
}

// ---------------------------------------------------------------- all

bool is_entered(const Grid& g, u32 f) {
  const u32 record = find_record(g.changes, f);
  return record == none ? f < g.tree->places : !is_empty(g.changes.hash.entry[record].box);
}

// From the tree and its changes to a table of all faces that are entered.
void hash_all(Grid& g) {
  const Mesh& m = *g.mesh;
  for (u32 f = 0; f < m.face_count; ++f) g.all.entry[f].box = is_entered(g, f) ? face_box(m, f) : empty_box;
  g.tree = nullptr;
  fill(g.all, m.face_count);
}

}  // namespace

u32 most_changes(u64 vertices) {
  u32 n = 1024;
  while (n < vertices / 32) n *= 2;
  return n;
}

void rebuild(Grid& g, const Mesh& m) {
  g.mesh = &m;
  g.tree = nullptr;
  for (u32 f = 0; f < m.face_count; ++f) g.all.entry[f].box = face_lives(m, f) ? face_box(m, f) : empty_box;
  fill(g.all, m.face_count);
}

void watch(Grid& g, const Mesh& m, const Clusters& tree) {
  g.mesh = &m;
  g.tree = &tree;
  g.changes.count = 0;
  set_slots(g.changes, fewest_slots);
}

void insert(Grid& g, const Mesh& m, u32 f) {
  if (g.tree != nullptr) {
    const u32 record = take_record(g.changes, f);
    if (record != none) {
      g.changes.hash.entry[record].box = face_box(m, f);
      enter(g.changes.hash, record);
      return;
    }
    hash_all(g);
  }
  g.all.entry[f].box = face_box(m, f);
  enter(g.all, f);
}

void remove(Grid& g, u32 f) {
  if (g.tree != nullptr) {
    const u32 record = take_record(g.changes, f);
    if (record != none) {
      HashEntry& entry = g.changes.hash.entry[record];
      if (!is_empty(entry.box)) leave(g.changes.hash, record);
      entry.box = empty_box;
      return;
    }
    hash_all(g);
  }
  leave(g.all, f);
}

bool has_room(const Grid& g, Span<const u32> faces) {
  u32 left = g.changes.capacity - g.changes.count;
  for (u32 f : faces) {
    if (find_record(g.changes, f) != none) continue;
    if (left-- == 0) return false;
  }
  return true;
}

GridShape shape_of(const Grid& g) { return {*g.tree, g.changes.hash, g.changes}; }

void resume(Grid& g, const Mesh& m, Clusters& tree, const GridShape& shape) {
  static_cast<TreeShape&>(tree) = shape.tree;
  static_cast<HashShape&>(g.changes.hash) = shape.hash;
  static_cast<ChangesShape&>(g.changes) = shape.changes;
  g.mesh = &m;
  g.tree = &tree;
}

void reenter(Grid& g, const Mesh& m, Span<const u32> faces) {
  for (u32 f : faces) {
    if (is_entered(g, f)) remove(g, f);
    if (f < m.face_count) insert(g, m, f);
  }
}

namespace {

struct Asking {
  bool (*ask)(void* data, u32 f);
  void* data;
};

u32 find_in_tree(const Grid& g, const Box& query, const Asking& asking) {
  const Clusters& tree = *g.tree;
  const auto corner = [](const f32* at) {
    return Vec3{static_cast<f64>(at[0]), static_cast<f64>(at[1]), static_cast<f64>(at[2])};
  };
  const FlatBox box = flat_box(tree.frame, corner(query.low), corner(query.high));
  const BroadBox wide = broad(box);
  const ConstBoxLanes boxes = lanes_of(tree.box);
  u32 found = none;
  for_each_cluster_near(tree, box, 0, [&](u32 cluster) {
    const u32 last = tree.first[cluster + 1];
    for (u32 i = tree.first[cluster]; i < last && found == none; i += 4)
      for (u32 rest = bits_of(lanes_meeting(boxes, i, wide) & first_lanes(last - i)); rest != 0; rest &= rest - 1) {
        const u32 f = face_at(tree, i + static_cast<u32>(__builtin_ctz(rest)));
        if (find_record(g.changes, f) != none || !asking.ask(asking.data, f)) continue;
        found = f;
        break;
      }
    return found == none;
  });
  return found;
}

// By face, or where records are given, by record.
u32 find_in_hash(const BoxHash& h, const u32* face_of_record, const Box& query, const Asking& asking) {
  const auto face = [&](u32 i) { return face_of_record == nullptr ? i : face_of_record[i]; };
  const u32 found = find_near(h, query, [&](u32 i) { return asking.ask(asking.data, face(i)); });
  return found == none ? none : face(found);
}

}  // namespace

namespace grid_detail {

u32 find(const Grid& g, const Box& query, bool (*ask)(void* data, u32 f), void* data) {
  const Asking asking{ask, data};
  if (g.tree == nullptr) return find_in_hash(g.all, nullptr, query, asking);
  const u32 changed = find_in_hash(g.changes.hash, g.changes.face, query, asking);
  return changed != none ? changed : find_in_tree(g, query, asking);
}

}  // namespace grid_detail

}  // namespace tpa
