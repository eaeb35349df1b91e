#include "detect/face_tree_edit.h"

#include <string.h>

namespace tpa {

namespace {

u32 place_of(const FaceTree& c, u32 f) { return f < c.numbered ? c.place[f] : none; }
void set_place(FaceTree& c, u32 f, u32 place) {
  while (c.numbered <= f) c.place[c.numbered++] = none;
  c.place[f] = place;
}

void move_places(FaceTree& c, u32 from, u32 to, u32 n) {
  memmove(c.face + to, c.face + from, n * sizeof *c.face);
  for (u32 k = 0; k < 3; ++k) {
    memmove(c.box.low[k] + to, c.box.low[k] + from, n);
    memmove(c.box.high[k] + to, c.box.high[k] + from, n);
  }
}

u32 cluster_of(const FaceTree& c, u32 place) {
  u32 cluster = c.row_cluster[place / places_in_row];
  while (c.first[cluster + 1] <= place) ++cluster;
  return cluster;
}

bool holds(const FaceTree& c, u32 node, const Box& box) {
  bool all = true;
  for (u32 k = 0; k < 3; ++k) all = all & (c.node.low[k][node] <= box.low[k]) & (box.high[k] <= c.node.high[k][node]);
  return all;
}

// Up the tree, as far as the box sticks out.
void grow(FaceTree& c, u32 cluster, const Box& box) {
  for (u32 l = 0, at = cluster; l < c.levels; ++l, at /= tree_branching) {
    const u32 node = c.level_first[l] + at;
    if (holds(c, node, box)) return;
    for (u32 k = 0; k < 3; ++k) {
      f32 &low = c.node.low[k][node], &high = c.node.high[k][node];
      low = min_of(low, box.low[k]), high = max_of(high, box.high[k]);
    }
  }
}

// Bytes that suit what the cluster has become, and twice that: what has grown goes on growing.
void widen_frame(FaceTree& c, u32 cluster) {
  Box box = node_box(c, cluster);
  for (u32 k = 0; k < 3; ++k) {
    const f32 half = 0.5f * (box.high[k] - box.low[k]);
    box.low[k] -= half, box.high[k] += half;
  }
  const ByteFrame frame = frame_round(box);
  change_frame(c.box, c.first[cluster], c.end[cluster], c.byte_frame[cluster], frame);
  c.byte_frame[cluster] = frame;
}

// The sum of a node's extents with the box in it, for four nodes at a time.
F4 extents_with(const FaceTree& c, u32 at, const BroadBox& box) {
  F4 sum = all4(0);
  for (u32 k = 0; k < 3; ++k) {
    const F4 low = load4(c.node.low[k] + at), high = load4(c.node.high[k] + at);
    sum += max4(high, box.high[k]) - min4(low, box.low[k]);
  }
  return sum;
}

// Down the tree, by the child that is smallest with the box in it. (The one that grows least would be a large one that
// overlaps many.)
u32 best_cluster(const FaceTree& c, const Box& box) {
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

bool has_gap(const FaceTree& c, u32 cluster) { return c.end[cluster] < c.first[cluster + 1]; }

// The cluster itself, else the next one before or behind it: there is a place for each face that the mesh may have.
u32 with_gap(const FaceTree& c, u32 cluster) {
  for (u32 i = 0;; ++i) {
    const u32 at = i % 2 == 0 ? cluster - i / 2 : cluster + (i + 1) / 2;
    if (at < c.count && has_gap(c, at)) return at;
  }
}

// The last face of the cluster moves to the place that becomes free.
void free_place(FaceTree& c, u32 f, u32 cluster) {
  const u32 place = c.place[f], last = --c.end[cluster];
  move_places(c, last, place, 1);
  c.place[c.face[place]] = place;
  c.place[f] = none;
}

// A place in the cluster that suits the box best, with no box yet. Where that has no gap a face that has a place stays
// there, and a new one goes to a cluster as near as can be. Returns the cluster.
u32 move_in_tree(FaceTree& c, u32 f, const Box& box, u32 cluster) {
  const u32 best = best_cluster(c, box), to = cluster == none || has_gap(c, best) ? with_gap(c, best) : cluster;
  constexpr u32 row = tree_branching;
  c.strays += to / row != best / row ? 1 : 0;
  if (to == cluster) return to;
  if (cluster != none) free_place(c, f, cluster);
  const u32 place = c.end[to]++;
  c.face[place] = f;
  set_box(c.box, place, no_byte_box);
  set_place(c, f, place);
  return to;
}

// In the cluster where the face is, if any, or in another one where that lies elsewhere: its bounds grow. Returns it.
u32 make_room(FaceTree& c, u32 f, const Box& box, u32 cluster) {
  if (cluster == none || !boxes_meet(node_box(c, cluster), box)) cluster = move_in_tree(c, f, box, cluster);
  grow(c, cluster, box);
  if (is_outgrown(c.byte_frame[cluster], node_box(c, cluster))) widen_frame(c, cluster);
  return cluster;
}

}  // namespace

void loosen(FaceTree& c, u32 capacity) {
  // Gaps are spread evenly, so that one is near also where there are fewer than clusters; all are used.
  const u32 gaps = capacity - c.places;
  u32 until = gaps;  // as many are before the cluster behind
  for (u32 i = c.count; i-- > 0;) {
    const u32 from = c.first[i], n = c.first[i + 1] - from, before = static_cast<u32>(u64{gaps} * i / c.count);
    move_places(c, from, from + before, n);
    c.end[i] = from + before + n;
    c.first[i + 1] += until;
    until = before;
  }
  c.places = capacity;
  for (u32 i = 0, row = 0; i < c.count; ++i)
    while (row * places_in_row < c.first[i + 1]) c.row_cluster[row++] = i;
  c.numbered = c.faces;
  memset(c.place, 0xFF, c.faces * sizeof *c.place);
  // What is written is none of what is read, which the compiler cannot know.
  u32* const place_by_face = c.place;
  const u32* const face = c.face;
  for (u32 i = 0; i < c.count; ++i)
    for (u32 place = c.first[i], end = c.end[i]; place < end; ++place) place_by_face[face[place]] = place;
}

bool is_in_tree(const FaceTree& c, u32 f) {
  const u32 place = place_of(c, f);
  return place != none && c.box.low[0][place] != no_byte_step;
}

void put_in_tree(FaceTree& c, u32 f, const Box& box) {
  const u32 place = place_of(c, f);
  u32 cluster = place == none ? none : cluster_of(c, place);
  if (cluster == none || !holds(c, cluster, box)) cluster = make_room(c, f, box, cluster);
  set_box(c.box, c.place[f], byte_box(c.byte_frame[cluster], box));
}

void take_from_tree(FaceTree& c, u32 f) { c.box.low[0][c.place[f]] = no_byte_step; }

void rename_in_tree(FaceTree& c, u32 f, u32 to) {
  const u32 place = c.place[f], empty = place_of(c, to);
  if (empty != none) c.face[empty] = f;
  c.place[f] = empty;
  c.face[place] = to;
  set_place(c, to, place);
}

}  // namespace tpa
