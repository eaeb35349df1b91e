#include "round_walk.h"

namespace tpa {

namespace {

struct Filling {
  const RoundWalk& w;
  const WalkEnds& ends;
  WalkTable& t;
};

// What it costs to enter each step of the next layer from step `step` of this one; no_way where that may not be.
void fill_entries(const Filling& f, const WalkState& from, f64 (&entry)[RoundWalk::reach]) {
  const u32 next = (track_of(f.w, f.ends, from.layer) + 1) % f.w.tracks;
  for (u32 j = 0; j <= f.w.sides[next]; ++j) {
    WalkState s = from;
    entry[j] = change(f.w, f.ends, j, s) ? f.w.around[next][from.row][j] + length_to_go(f.t, s) : no_way;
  }
}

f64 best_sum(const f64 (&link)[RoundWalk::reach], const f64 (&entry)[RoundWalk::reach], u32 sides) {
  f64 even = no_way, odd = no_way;  // two chains of comparisons run side by side
  u32 j = 0;
  for (; j + 1 <= sides; j += 2) {
    even = min_of(even, link[j] + entry[j]);
    odd = min_of(odd, link[j + 1] + entry[j + 1]);
  }
  if (j == sides) even = min_of(even, link[j] + entry[j]);
  return min_of(even, odd);
}

// By a change of track from each step of a layer, for one set of marks. Where entries can depend on the step that is
// left, at the last one and at home, they are made again.
void fill_changes(const Filling& f, WalkState from, f64 (&leave)[RoundWalk::reach]) {
  const u32 track = track_of(f.w, f.ends, from.layer), next = (track + 1) % f.w.tracks, n = f.w.sides[track];
  f64 entry[RoundWalk::reach];
  bool usual = false;
  for (u32 i = 0; i <= n; ++i) {
    const bool special = from.layer == 0 && (i == n || i == f.ends.end);
    from.step = static_cast<u8>(i);
    if (special || !usual) fill_entries(f, from, entry);
    usual = !special;
    leave[i] = best_sum(f.w.link[track][i], entry, f.w.sides[next]);
  }
}

// By a step on D from each step of a layer, or home.
void fill_downs(const Filling& f, const WalkState& from, f64 (&out)[RoundWalk::reach]) {
  const u32 track = track_of(f.w, f.ends, from.layer);
  for (u32 i = 0; i <= f.w.sides[track]; ++i) {
    WalkState s = from;
    s.step = static_cast<u8>(i);
    if (is_home(f.w, f.ends, s))
      out[i] = 0;
    else
      out[i] = down(f.w, f.ends, s) ? f.w.around[track][s.row][i] + length_to_go(f.t, s) : no_way;
  }
}

// All steps of one layer in one row, for one set of marks without and with mark_first.
void fill_layer(const Filling& f, u32 row, u32 layer, u32 marks) {
  const u32 track = track_of(f.w, f.ends, layer), n = f.w.sides[track];
  const WalkState s{static_cast<u8>(row), static_cast<u8>(layer), 0, static_cast<u8>(marks)};
  f64 here[RoundWalk::reach], leave[RoundWalk::reach];
  fill_downs(f, s, here);
  if (layer != f.w.tracks) {
    fill_changes(f, s, leave);
    for (u32 i = 0; i <= n; ++i) here[i] = min_of(here[i], leave[i]);
  }
  for (u32 first = 0; first <= mark_first; ++first)
    for (u32 i = n + 1; i-- > 0;) {
      WalkState at = s;
      at.marks = static_cast<u8>(marks | first), at.step = static_cast<u8>(i);
      f64& out = f.t.to_go[row][layer][at.marks][i];
      out = along(f.w, f.ends, at) ? min_of(here[i], f.w.around[track][row][i + 1] + length_to_go(f.t, at)) : here[i];
    }
}

// The last layer has nothing behind it but rows; the others follow in reverse order of the walk.
constexpr u32 layer_order(const RoundWalk& w, u32 at) {
  constexpr u8 of_three[4] = {3, 2, 1, 0}, of_two[4] = {2, 1, still_layer, 0};
  return w.tracks == 3 ? of_three[at] : of_two[at];
}

}  // namespace

void fill_walk_table(const RoundWalk& w, const WalkEnds& ends, WalkTable& t) {
  const Filling f{w, ends, t};
  const bool open = ends.end == none;  // leaves nothing to mark but first steps
  for (u32 row = w.rows; row-- > 0;)
    for (u32 at = 0; at < walk_layers; ++at) {
      const u32 layer = layer_order(w, at);
      if (is_still(w, layer) && (open || !w.must_move)) continue;
      const u32 sets = open ? mark_home : layer == 0 || layer == w.tracks ? mark_last : mark_sets;
      for (u32 marks = 0; marks < sets; marks += mark_home) fill_layer(f, row, layer, marks);
    }
}

}  // namespace tpa
