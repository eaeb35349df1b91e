#include "refit.h"

#include <float.h>
#include <string.h>

#include "order.h"

namespace tpa {

namespace {

constexpr FlatBox nothing = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};

u32 place_of(const Clusters& c, u32 f) { return f < c.numbered ? c.place[f] : none; }
void set_place(Clusters& c, u32 f, u32 place) {
  while (c.numbered <= f) c.place[c.numbered++] = none;
  c.place[f] = place;
}

void set_box(Clusters& c, u32 place, const FlatBox& box) {
  for (u32 k = 0; k < 3; ++k) c.box.low[k][place] = box.low[k], c.box.high[k][place] = box.high[k];
}

void move_places(Clusters& c, u32 from, u32 to, u32 n) {
  memmove(c.face + to, c.face + from, n * sizeof *c.face);
  for (u32 k = 0; k < 3; ++k) {
    memmove(c.box.low[k] + to, c.box.low[k] + from, n * sizeof(f32));
    memmove(c.box.high[k] + to, c.box.high[k] + from, n * sizeof(f32));
  }
}

// Faces that change one after another are mostly near each other.
u32 cluster_of(Clusters& c, u32 place) {
  if (c.first[c.recent] <= place && place < c.first[c.recent + 1]) return c.recent;
  c.recent = count_before(c.first + 1, c.count - 1, [&](u32 first) { return first <= place; });
  return c.recent;
}

bool holds(const Clusters& c, u32 node, const FlatBox& box) {
  bool all = true;
TPA_UNROLL(3)
  for (u32 k = 0; k < 3; ++k) all = all & (c.node.low[k][node] <= box.low[k]) & (box.high[k] <= c.node.high[k][node]);
  return all;
}

// Up the tree, as far as the box sticks out.
void grow(Clusters& c, u32 cluster, const FlatBox& box) {
  for (u32 l = 0, at = cluster; l < c.levels; ++l, at /= tree_branching) {
    const u32 node = c.level_first[l] + at;
    if (holds(c, node, box)) return;
    for (u32 k = 0; k < 3; ++k) {
      f32 &low = c.node.low[k][node], &high = c.node.high[k][node];
      low = min_of(low, box.low[k]), high = max_of(high, box.high[k]);
    }
  }
}

// The sum of a node's extents with the box in it, for four nodes at a time.
F4 extents_with(const Clusters& c, u32 at, const BroadBox& box) {
  F4 sum = all4(0);
  for (u32 k = 0; k < 3; ++k) {
    const F4 low = load4(c.node.low[k] + at), high = load4(c.node.high[k] + at);
    sum += max4(high, box.high[k]) - min4(low, box.low[k]);
  }
  return sum;
}

// Down the tree, by the child that is smallest with the box in it. (The one that grows least would be a large one that
// overlaps many.)
u32 best_cluster(const Clusters& c, const FlatBox& box) {
  const BroadBox wide = broad(box);
  u32 node = 0;
  for (u32 l = c.levels; l-- > 0;) {
    const u32 row = node, last = min_of(row + tree_branching, c.level_size[l]);
    f32 sum[tree_branching];
    store4(sum, extents_with(c, c.level_first[l] + row, wide));
    store4(sum + 4, extents_with(c, c.level_first[l] + row + 4, wide));
    f32 least = sum[0];
    for (u32 i = row + 1; i < last; ++i) {
      const f32 of_i = sum[i - row];
      node = of_i < least ? i : node;
      least = min_of(least, of_i);
    }
    if (l > 0) node *= tree_branching;
  }
  return node;
}

bool has_gap(const Clusters& c, u32 cluster) { return c.end[cluster] < c.first[cluster + 1]; }

// The cluster itself, or one beside it in the tree; none where all are full.
u32 with_gap(const Clusters& c, u32 cluster) {
  const u32 row = cluster / tree_branching * tree_branching, last = min_of(row + tree_branching, c.count);
  if (has_gap(c, cluster)) return cluster;
  for (u32 i = row; i < last; ++i)
    if (has_gap(c, i)) return i;
  return none;
}

}  // namespace

[[gnu::cold]] void loosen(Clusters& c, u32 capacity) {
  const u32 gaps = c.count == 0 ? 0 : (capacity - c.places) / c.count;
  for (u32 i = c.count; i-- > 0;) {
    const u32 from = c.first[i], n = c.first[i + 1] - from, to = from + i * gaps;
    move_places(c, from, to, n);
    c.end[i] = to + n;
    c.first[i + 1] += (i + 1) * gaps;
  }
  c.places += c.count * gaps;
  c.numbered = c.faces;
  memset(c.place, 0xFF, c.faces * sizeof *c.place);
  for (u32 i = 0; i < c.count; ++i)
    for (u32 place = c.first[i]; place < c.end[i]; ++place) c.place[face_at(c, place)] = place;
}

bool is_in_tree(const Clusters& c, u32 f) {
  const u32 place = place_of(c, f);
  return place != none && c.box.low[0][place] <= c.box.high[0][place];
}

bool put_in_tree(Clusters& c, u32 f, const FlatBox& box) {
  u32 place = place_of(c, f), cluster = none;
  if (place != none) {
    cluster = cluster_of(c, place);
    if (holds(c, cluster, box)) {
      set_box(c, place, box);
      return true;
    }
    if (!boxes_meet(node_box(c, cluster), box)) {
      set_box(c, place, nothing);
      set_place(c, f, none);
      place = none;
    }
  }
  if (place == none) {
    if (c.count == 0) return false;
    cluster = with_gap(c, best_cluster(c, box));
    if (cluster == none) return false;
    place = c.end[cluster]++;
    c.face[place] = f;
    set_place(c, f, place);
  }
  set_box(c, place, box);
  grow(c, cluster, box);
  return true;
}

bool take_from_tree(Clusters& c, u32 f) {
  if (!is_in_tree(c, f)) return false;
  set_box(c, place_of(c, f), nothing);
  return true;
}

}  // namespace tpa
