// four_star_walk: the shortest closed walk around one polygon D of a handle (docs/handles.md). D is traversed
// backwards, the polygons around it, the tracks, forwards; each step makes one face, and so does each change from one
// track to the next. What a change costs is what it leaves between the two tracks on their other side.
//
// A walk must not have an edge of D twice. That could happen in four ways, all within one row, that is at one vertex
// of D: a whole track is passed; a track is left at its last step and entered again at its first; the walk goes once
// round where it began, D having been traversed without a step on a track; or (which the caller may forbid) there is
// no step on any track at all. Marks keep them apart.
#pragma once

#include "base/arena.h"
#include "base/vec3.h"

namespace tpa {

// What is asked of the steps on a track.
enum class TrackSteps : u8 { free, some, zero };

struct RoundWalk {
  u32 rows = 0;            // sides of D; row r is D's vertex rows - r
  u32 tracks = 0;          // 2 or 3, in cyclic order
  u32 sides[3] = {};       // of the tracks; a track begins at step 0 and ends at most at step `sides`
  bool must_move = false;  // there has to be a step on a track; for two tracks only
  bool barred[3] = {};     // tracks without steps
  // By the track that a walk begins on: has that one to be stepped on, or the other one?
  bool start_must_step[3] = {}, other_must_step[3] = {};
  Rows<f64> around[3];              // [track][row][step]: length of the edge between
  Rows<bool> by_track[3], by_d[3];  // may the edge be reached by a step on the track, on D?
  Rows<f64> link[3];                // [track][i][j]: leaving it at step i, entering the next one at step j
};

// What this row has seen.
inline constexpr u8 mark_first = 1;  // step 0 of this layer
inline constexpr u8 mark_home = 2;   // on layer 0, the step where the walk began
inline constexpr u8 mark_last = 4;   // layer 0 left at its last step
inline constexpr u32 mark_sets = 8;

// The walk is cut open where D's vertex 0 has just been reached, on one of the tracks. Layers count the tracks from
// that one; the last layer is the same track again, up to where the walk began. Where a walk between two tracks must
// move, layer 3 is layer 1 as long as it has not, on the tracks that count.
struct WalkState {
  u16 row = 0, step = 0;
  u8 layer = 0, marks = 0;
};
inline constexpr u32 walk_layers = 4, still_layer = 3;

// [row][layer][marks][step]. Layer 0 has been left nowhere.
struct WalkTable {
  static constexpr u32 lines = mark_last + 3 * mark_sets;  // of a row
  f64* to_go = nullptr;
  u32 width = 0;      // of a line
  f64* line[3] = {};  // in the filling: each for the steps of a track
};
constexpr f64* walk_line(const WalkTable& t, u32 row, u32 layer, u32 marks) {
  const u32 before = layer == 0 ? 0 : mark_sets * layer - mark_last;
  return t.to_go + u64{row * WalkTable::lines + before + marks} * t.width;
}
// The shortest way to go from a state, excluding the edge that the state stands on.
constexpr f64 length_to_go(const WalkTable& t, const WalkState& s) {
  return walk_line(t, s.row, s.layer, s.marks)[s.step];
}

// Walks that begin on track `start` at step `end`, and end there. For end = none: at any step from `low` to `high`, not
// necessarily the same, and edges may occur twice: a lower bound for all these starts.
struct WalkEnds {
  u32 start = 0, end = none;
  u32 low = 0, high = none;
};
constexpr bool is_still(const RoundWalk& w, u32 layer) { return w.tracks == 2 && layer == still_layer; }
constexpr u32 track_of(const RoundWalk& w, const WalkEnds& ends, u32 layer) {
  return is_still(w, layer) ? (ends.start + 1) % 2 : (ends.start + layer) % w.tracks;
}
constexpr bool has_still_layer(const RoundWalk& w, const WalkEnds& ends) {
  return w.must_move && (ends.end != none || w.other_must_step[ends.start]);
}
constexpr WalkState walk_start(const WalkEnds& ends, u32 step) {
  const u32 marks = (step == 0 ? mark_first : 0) | (ends.end == step ? mark_home : 0);
  return {0, static_cast<u16>(step), 0, static_cast<u8>(marks)};
}
// Does a step on D end the walk here?
constexpr bool is_home(const RoundWalk& w, const WalkEnds& ends, const WalkState& s) {
  return s.row + 1u == w.rows && s.layer == w.tracks && w.by_d[ends.start][0][s.step] &&
         (ends.end == none ? ends.low <= s.step && s.step <= ends.high : ends.end == s.step);
}

// The state after a step on D, on the track, or a change to step j of the next track; false where that may not be.
constexpr bool down(const RoundWalk& w, const WalkEnds& ends, WalkState& s) {
  if (s.row + 1u == w.rows || !w.by_d[track_of(w, ends, s.layer)][s.row + 1u][s.step]) return false;
  ++s.row;
  s.marks = static_cast<u8>((s.step == 0 ? mark_first : 0) | (s.layer == 0 && s.step == ends.end ? mark_home : 0));
  return true;
}

constexpr bool along(const RoundWalk& w, const WalkEnds& ends, WalkState& s) {
  const u32 track = track_of(w, ends, s.layer), n = w.sides[track], step = s.step + 1u;
  if (step > n || !w.by_track[track][s.row][step] || (step == n && (s.marks & mark_first))) return false;
  if (s.layer == w.tracks && (s.marks & mark_home) && step == ends.end) return false;
  if (w.barred[track]) return false;
  if (is_still(w, s.layer) && !w.start_must_step[ends.start]) s.layer = 1;
  s.step = static_cast<u16>(step);
  return true;
}

constexpr bool change(const RoundWalk& w, const WalkEnds& ends, u32 j, WalkState& s) {
  const bool still = is_still(w, s.layer);
  const u32 track = track_of(w, ends, s.layer), next = (track + 1) % w.tracks;
  if ((s.layer == w.tracks && !still) || j > w.sides[next] || (still && w.other_must_step[ends.start])) return false;
  u32 marks = s.marks & (mark_home | mark_last);
  if (s.layer == 0 && s.step == w.sides[track] && ends.end != none) marks |= mark_last;
  u32 layer = still ? 2 : s.layer + 1u;
  if (layer == w.tracks) {
    if ((marks & mark_last) && j == 0) return false;
    if (((marks & mark_home) || still) && j == ends.end) return false;
    marks &= mark_home;
  } else if (w.must_move && s.layer == 0 && (s.step == ends.end || w.other_must_step[ends.start])) {
    layer = still_layer;
  }
  s.layer = static_cast<u8>(layer), s.step = static_cast<u16>(j);
  s.marks = static_cast<u8>(marks | (j == 0 ? mark_first : 0));
  return true;
}

// Take room for walks where rows times longest track and track times next track, each with one more step, are `cells`
// at most.
void lay_out_round_walk(Carver& carver, u64 cells, RoundWalk& walk);
void lay_out_walk_table(Carver& carver, u64 cells, u32 longest, WalkTable& table);
// To be called before the rest is set.
void set_sides(u32 rows, u32 tracks, const u32 (&sides)[3], RoundWalk& walk);
// Of two tracks, what is asked of one: the other is free, but has to be stepped on where the one may not be.
void ask_of_track(u32 track, TrackSteps steps, RoundWalk& walk);

void fill_walk_table(const RoundWalk& walk, const WalkEnds& ends, WalkTable& table);

}  // namespace tpa
