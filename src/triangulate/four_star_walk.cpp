#include "triangulate/four_star_walk.h"

namespace tpa {

namespace {

struct Filling {
  const RoundWalk& w;
  const WalkEnds& ends;
  const WalkTable& t;
};

// What it costs to enter each step of the next layer from step `step` of this one; no_way where that may not be. All
// steps but the first and the one where the walk began are alike.
void fill_entries(const Filling& f, const WalkState& from, f64* entry) {
  const u32 next = (track_of(f.w, f.ends, from.layer) + 1) % f.w.tracks, n = f.w.sides[next];
  const f64* around = f.w.around[next][from.row];
  const u32 usual = f.ends.end == 1 ? 2 : 1, steps[3] = {usual, 0, f.ends.end};
  for (const u32 j : steps) {
    if (j > n) continue;
    WalkState s = from;
    const bool open = change(f.w, f.ends, j, s);
    const f64* line = walk_line(f.t, s.row, s.layer, s.marks);
    const u32 first = j == usual ? 0 : j, last = j == usual ? n : j;
    for (u32 i = first; i <= last; ++i) entry[i] = open ? around[i] + line[i] : no_way;
  }
}

f64 best_sum(const f64* link, const f64* entry, u32 sides) {
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
void fill_changes(const Filling& f, WalkState from, f64* leave) {
  const u32 track = track_of(f.w, f.ends, from.layer), next = (track + 1) % f.w.tracks, n = f.w.sides[track];
  f64* entry = f.t.line[2];
  bool usual = false;
  for (u32 i = 0; i <= n; ++i) {
    const bool special = from.layer == 0 && (i == n || i == f.ends.end);
    from.step = static_cast<u16>(i);
    if (special || !usual) fill_entries(f, from, entry);
    usual = !special;
    leave[i] = best_sum(f.w.link[track][i], entry, f.w.sides[next]);
  }
}

// By a step on D from each step of a layer, or home.
void fill_downs(const Filling& f, const WalkState& from, f64* out) {
  const u32 track = track_of(f.w, f.ends, from.layer), n = f.w.sides[track];
  WalkState s = from;
  if (from.row + 1u == f.w.rows) {
    for (u32 i = 0; i <= n; ++i) s.step = static_cast<u16>(i), out[i] = is_home(f.w, f.ends, s) ? 0 : no_way;
    return;
  }
  const f64 *around = f.w.around[track][from.row + 1u], *line = walk_line(f.t, from.row + 1u, from.layer, 0);
  const bool* by_d = f.w.by_d[track][from.row + 1u];
  for (u32 i = 1; i <= n; ++i) out[i] = by_d[i] ? around[i] + line[i] : no_way;
  const u32 others[2] = {0, f.ends.end};
  for (const u32 i : others) {
    if (i > n) continue;
    s = from, s.step = static_cast<u16>(i);
    out[i] = down(f.w, f.ends, s) ? around[i] + length_to_go(f.t, s) : no_way;
  }
}

// By a step on the track, or else as `here` says, for one set of marks without and with mark_first. All steps but the
// last one and the one where the walk began are alike.
void fill_alongs(const Filling& f, const WalkState& from, const f64* here) {
  const u32 track = track_of(f.w, f.ends, from.layer), n = f.w.sides[track];
  const bool moves_on = is_still(f.w, from.layer) && !f.w.start_must_step[f.ends.start];
  const u32 row = from.row, ahead_on = moves_on ? 1 : from.layer, marked = from.marks | mark_first;
  f64 *out = walk_line(f.t, row, from.layer, from.marks), *out_first = walk_line(f.t, row, from.layer, marked);
  const f64 *ahead = walk_line(f.t, row, ahead_on, from.marks), *ahead_first = walk_line(f.t, row, ahead_on, marked);
  const f64* around = f.w.around[track][row];
  const bool *by_track = f.w.by_track[track][row], barred = f.w.barred[track];
  out[n] = out_first[n] = here[n];
  for (u32 i = n; i-- > 0;) {
    bool open = by_track[i + 1] && !barred, open_first = open;
    if (i + 1 == n || i + 1 == f.ends.end) {
      WalkState s = from, first = from;
      s.step = first.step = static_cast<u16>(i), first.marks = static_cast<u8>(marked);
      open = along(f.w, f.ends, s), open_first = along(f.w, f.ends, first);
    }
    out[i] = open ? min_of(here[i], around[i + 1] + ahead[i + 1]) : here[i];
    out_first[i] = open_first ? min_of(here[i], around[i + 1] + ahead_first[i + 1]) : here[i];
  }
}

// All steps of one layer in one row, for so many sets of marks.
void fill_layer(const Filling& f, u32 row, u32 layer, u32 sets) {
  const u32 n = f.w.sides[track_of(f.w, f.ends, layer)];
  WalkState at{static_cast<u16>(row), 0, static_cast<u8>(layer), 0};
  f64 *down = f.t.line[0], *leave = f.t.line[1];
  fill_downs(f, at, down);
  for (u32 marks = 0; marks < sets; marks += mark_home) {
    at.marks = static_cast<u8>(marks);
    if (layer != f.w.tracks) {
      fill_changes(f, at, leave);
      for (u32 i = 0; i <= n; ++i) leave[i] = min_of(leave[i], down[i]);
    }
    fill_alongs(f, at, layer != f.w.tracks ? leave : down);
  }
}

// The last layer has nothing behind it but rows; the others follow in reverse order of the walk.
constexpr u32 layer_order(const RoundWalk& w, u32 at) {
  constexpr u8 of_three[4] = {3, 2, 1, 0}, of_two[4] = {2, 1, still_layer, 0};
  return w.tracks == 3 ? of_three[at] : of_two[at];
}

}  // namespace

void lay_out_round_walk(Carver& carver, u64 cells, RoundWalk& w) {
  for (u32 t = 0; t < 3; ++t) {
    carver.take(w.around[t].data, cells), carver.take(w.link[t].data, cells);
    carver.take(w.by_track[t].data, cells), carver.take(w.by_d[t].data, cells);
  }
}

void lay_out_walk_table(Carver& carver, u64 cells, u32 longest, WalkTable& t) {
  carver.take(t.to_go, WalkTable::lines * cells);
  for (f64*& line : t.line) carver.take(line, u64{longest} + 1);
}

void set_sides(u32 rows, u32 tracks, const u32 (&sides)[3], RoundWalk& w) {
  w.rows = rows, w.tracks = tracks;
  for (u32 t = 0; t < 3; ++t) w.barred[t] = w.start_must_step[t] = w.other_must_step[t] = false;
  for (u32 t = 0; t < tracks; ++t) {
    w.sides[t] = sides[t];
    w.around[t].width = w.by_track[t].width = w.by_d[t].width = sides[t] + 1;
    w.link[t].width = sides[(t + 1) % tracks] + 1;
  }
}

void ask_of_track(u32 track, TrackSteps steps, RoundWalk& w) {
  const u32 other = 1 - track, moving = steps == TrackSteps::some ? track : other;
  const bool asked = steps != TrackSteps::free;
  w.barred[track] = steps == TrackSteps::zero, w.barred[other] = false;
  w.start_must_step[moving] = w.other_must_step[1 - moving] = asked;
  w.start_must_step[1 - moving] = w.other_must_step[moving] = false;
}

void fill_walk_table(const RoundWalk& w, const WalkEnds& ends, WalkTable& t) {
  t.width = 0;
  for (u32 track = 0; track < w.tracks; ++track) t.width = max_of(t.width, w.sides[track] + 1);
  const Filling f{w, ends, t};
  const bool open = ends.end == none;  // leaves nothing to mark but first steps
  for (u32 row = w.rows; row-- > 0;)
    for (u32 at = 0; at < walk_layers; ++at) {
      const u32 layer = layer_order(w, at);
      if (is_still(w, layer) && !has_still_layer(w, ends)) continue;
      const u32 sets = open ? mark_home : layer == 0 || layer == w.tracks ? mark_last : mark_sets;
      fill_layer(f, row, layer, sets);
    }
}

}  // namespace tpa
