// SPDX-License-Identifier: MIT
#include "detect/face_tree_edit.h"

#include <string.h>

namespace tpa {

namespace {

u32 place_of(const FaceTree& tree, u32 f) { return f < tree.numbered ? tree.place[f] : none; }
void set_place(FaceTree& tree, u32 f, u32 place) {
  while (tree.numbered <= f) tree.place[tree.numbered++] = none;
  tree.place[f] = place;
}

void move_places(FaceTree& tree, u32 from, u32 to, u32 n) {
  memmove(tree.face + to, tree.face + from, n * sizeof *tree.face);
  for (u32 k = 0; k < 3; ++k) {
    memmove(tree.box.low[k] + to, tree.box.low[k] + from, n);
    memmove(tree.box.high[k] + to, tree.box.high[k] + from, n);
  }
}

u32 leaf_of(const FaceTree& tree, u32 place) {
  u32 leaf = tree.row_leaf[place / places_in_row];
  while (tree.first[leaf + 1] <= place) ++leaf;
  return leaf;
}

bool holds(const FaceTree& tree, u32 node, const Box& box) {
  bool all = true;
  for (u32 k = 0; k < 3; ++k)
    all = all & (tree.node.low[k][node] <= box.low[k]) & (box.high[k] <= tree.node.high[k][node]);
  return all;
}

// Extends the boxes of a leaf and of all nodes above, up to the first node with the box inside.
void grow_bounds(FaceTree& tree, u32 leaf, const Box& box) {
  for (u32 l = 0, at = leaf; l < tree.levels; ++l, at /= tree_branching) {
    const u32 node = tree.level_first[l] + at;
    if (holds(tree, node, box)) return;
    for (u32 k = 0; k < 3; ++k) {
      f32 &low = tree.node.low[k][node], &high = tree.node.high[k][node];
      low = min_of(low, box.low[k]), high = max_of(high, box.high[k]);
    }
  }
}

// Counts the boxes of a leaf in a frame twice as large as its bounds, since grown bounds go on growing.
void widen_frame(FaceTree& tree, u32 leaf) {
  Box box = node_box(tree, leaf);
  for (u32 k = 0; k < 3; ++k) {
    const f32 half = 0.5f * (box.high[k] - box.low[k]);
    box.low[k] -= half, box.high[k] += half;
  }
  const QuantizedFrame frame = frame_round(box);
  change_frame(tree.box, tree.first[leaf], tree.end[leaf], tree.byte_frame[leaf], frame);
  tree.byte_frame[leaf] = frame;
}

bool has_gap(const FaceTree& tree, u32 leaf) { return tree.end[leaf] < tree.first[leaf + 1]; }

f32 extents_with(const FaceTree& tree, u32 leaf, const Box& box) {
  f32 sum = 0;
  for (u32 k = 0; k < 3; ++k)
    sum += max_of(tree.node.high[k][leaf], box.high[k]) - min_of(tree.node.low[k][leaf], box.low[k]);
  return sum;
}

// Of the leaves that meet `near`, one of smallest extent when united with the box, a leaf with a gap if there is one;
// none if no leaf meets `near`. (Least growth would favour large leaves, overlapping many others.)
u32 best_leaf_near(const FaceTree& tree, const Box& near, const Box& box) {
  u32 best = none;
  bool with_gap = false;
  f32 least = 0;
  for_each_leaf_near(tree, near, 0, [&](u32 leaf) {
    const bool has = has_gap(tree, leaf);
    const f32 sum = extents_with(tree, leaf, box);
    if (best == none || (has != with_gap ? has : sum < least)) best = leaf, with_gap = has, least = sum;
    return true;
  });
  return best;
}

// Leaves that meet the box grow by no more than the box. Where there is none, the box grows until one is met.
u32 best_leaf(const FaceTree& tree, const Box& box) {
  Box near = box;
  for (f32 reach = 0x1p-20f;; reach *= 2) {
    if (const u32 leaf = best_leaf_near(tree, near, box); leaf != none) return leaf;
    for (u32 k = 0; k < 3; ++k) near.low[k] = box.low[k] - reach, near.high[k] = box.high[k] + reach;
  }
}

// The nearest leaf with a gap in the order of leaves. One exists: there is a place for each face of a full mesh.
// `looked` becomes the number of leaves looked at.
u32 with_gap(const FaceTree& tree, u32 leaf, u32& looked) {
  for (u32 i = 0;; ++i) {
    looked = i + 1;
    const u32 at = i % 2 == 0 ? leaf - i / 2 : leaf + (i + 1) / 2;
    if (at < tree.count && has_gap(tree, at)) return at;
  }
}

// A face to be put in.
struct Newcomer {
  u32 f;
  const u32* corner;
  const Box& box;
};

// May the face be in the leaf, or would it end the use of the leaf's hub?
bool fits(const FaceTree& tree, u32 leaf, const Newcomer& x) {
  const u32 hub = tree.has_hubs ? tree.hub[leaf] : none;
  return hub == none || x.corner[0] == hub || x.corner[1] == hub || x.corner[2] == hub;
}

// The same for a fitting leaf, if one lies near. Otherwise a leaf becomes one for all later faces near by.
u32 fitting_with_gap(const FaceTree& tree, u32 leaf, const Newcomer& x, u32& looked) {
  constexpr u32 most_looked = 32;
  for (u32 i = 0; tree.has_hubs && i < most_looked; ++i) {
    looked = i + 1;
    const u32 at = i % 2 == 0 ? leaf - i / 2 : leaf + (i + 1) / 2;
    if (at < tree.count && has_gap(tree, at) && fits(tree, at, x)) return at;
  }
  return with_gap(tree, leaf, looked);
}

// Frees the place of a face: the last face of the leaf moves there.
void free_place(FaceTree& tree, u32 f, u32 leaf) {
  const u32 place = tree.place[f], last = --tree.end[leaf];
  move_places(tree, last, place, 1);
  tree.place[tree.face[place]] = place;
  tree.place[f] = none;
}

// Moves a face to the best leaf for its box, without a box yet; returns the leaf. Without a gap there, a face of the
// tree stays in `leaf`, and a new face (`leaf` none) goes to the nearest leaf with a gap. A face outside the best
// leaf's row of eight is a stray.
u32 move_in_tree(FaceTree& tree, const Newcomer& x, u32 leaf, u32& looked) {
  const u32 f = x.f, best = best_leaf(tree, x.box);
  const u32 to = leaf == none || has_gap(tree, best) ? fitting_with_gap(tree, best, x, looked) : leaf;
  constexpr u32 row = tree_branching;
  tree.strays += to / row != best / row && fits(tree, best, x) ? 1u : 0u;
  if (to == leaf) return to;
  if (leaf != none) free_place(tree, f, leaf);
  const u32 place = tree.end[to]++;
  tree.face[place] = f;
  set_box(tree.box, place, no_byte_box);
  set_place(tree, f, place);
  return to;
}

// Returns a leaf for a face with a box: the present leaf if its bounds meet the box, otherwise another leaf if a gap is
// left. Extends the bounds by the box.
u32 make_room(FaceTree& tree, const Newcomer& x, u32 leaf, u32& looked) {
  if (leaf == none || !fits(tree, leaf, x) || !boxes_meet(node_box(tree, leaf), x.box))
    leaf = move_in_tree(tree, x, leaf, looked);
  grow_bounds(tree, leaf, x.box);
  if (is_outgrown(tree.byte_frame[leaf], node_box(tree, leaf))) widen_frame(tree, leaf);
  return leaf;
}

}  // namespace

void loosen(FaceTree& tree, u32 capacity) {
  // Even shares of the gaps, rounded so that all are used. Leaves move from the last one on.
  const u32 gaps = capacity - tree.places;
  u32 until = gaps;  // gaps before the leaf behind
  for (u32 i = tree.count; i-- > 0;) {
    const u32 from = tree.first[i], n = tree.first[i + 1] - from, before = static_cast<u32>(u64{gaps} * i / tree.count);
    move_places(tree, from, from + before, n);
    tree.end[i] = from + before + n;
    tree.first[i + 1] += until;
    until = before;
  }
  tree.places = capacity;
  for (u32 i = 0, row = 0; i < tree.count; ++i)
    while (row * places_in_row < tree.first[i + 1]) tree.row_leaf[row++] = i;
  tree.numbered = tree.faces;
  memset(tree.place, 0xFF, tree.faces * sizeof *tree.place);
  for (u32 i = 0; i < tree.count; ++i)
    for (u32 place = tree.first[i]; place < tree.end[i]; ++place) tree.place[tree.face[place]] = place;
}

bool is_in_tree(const FaceTree& tree, u32 f) {
  const u32 place = place_of(tree, f);
  return place != none && tree.box.low[0][place] != no_byte_step;
}

PutInTree put_in_tree(FaceTree& tree, u32 f, const u32* corner, const Box& box) {
  const Newcomer x{f, corner, box};
  const u32 place = place_of(tree, f);
  u32 leaf = place == none ? none : leaf_of(tree, place), looked = 0;
  if (leaf == none || !fits(tree, leaf, x) || !holds(tree, leaf, box)) leaf = make_room(tree, x, leaf, looked);
  set_box(tree.box, tree.place[f], byte_box(tree.byte_frame[leaf], box));
  return {leaf, looked};
}

void take_from_tree(FaceTree& tree, u32 f) { tree.box.low[0][tree.place[f]] = no_byte_step; }

void rename_in_tree(FaceTree& tree, u32 f, u32 to) {
  const u32 place = tree.place[f], empty = place_of(tree, to);
  if (empty != none) tree.face[empty] = f;
  tree.place[f] = empty;
  tree.face[place] = to;
  set_place(tree, to, place);
}

}  // namespace tpa
