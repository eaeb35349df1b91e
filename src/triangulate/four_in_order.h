// four_in_order: the handles of least total edge length between four polygons, in order (docs/handles.md).
//
// Take one polygon, D, out. Its star is a closed walk around it (triangulate/four_star_walk.h); what is left of the
// handle are strips that begin at a base (triangulate/four_base.h), for which the shortest are known. A search through
// all bases, cases of polygons in a row (triangulate/four_row_cases.h), starts of the walk, walks and strips, depth
// first, follows only what can still be among the best: it knows the least length to go, and that is exact as far as
// inner triangles are free. So where all are, whatever is followed ends in a handle.
#pragma once

#include "triangulate/four_best.h"
#include "triangulate/four_row_cases.h"

namespace tpa {

inline constexpr u32 most_four_vertices = 0xFFFF;

// A step of the search: what has been decided last.
struct ShortStep {
  enum class Phase : u8 { walk, strip };
  Phase phase = Phase::walk;
  WalkState walk;  // Phase::walk
  u8 piece = 0;    // Phase::strip: which piece, and the steps left on its polygons
  StripRule rule = StripRule::any;
  u16 i = 0, j = 0;
  u16 faces = 0;   // made so far
  u32 option = 0;  // the next one to try
  f64 spent = 0;   // all but what is to go on the present piece
};

// What is left to do beside the walk: a strip, and as many steps of it.
struct ShortPiece {
  u8 strip = 0;
  u16 i = 0, j = 0;
};

struct ShortestScratch {
  static constexpr u32 pieces = 4;
  BaseScratch base;
  WalkTable table;
  f64* least = nullptr;  // from each start of a walk
  ShortStep* step = nullptr;
  ShortPiece piece[pieces];
  u16 left_at[3] = {}, entered_at[3] = {};  // by the walk, for each track
  HandleFace* face = nullptr;               // in hand
  FaceMemory inner;                         // of inner triangles, each way round
  u64 inner_places[4] = {};                 // where they begin, by the loop that they do not touch
  ShortHandles found;
};

// Bytes of scratch for so many handles, aligned for f64: the squares of the vertices, and of the longest polygon.
u64 four_scratch_bytes(const ShortLoops& loops, u32 wanted);
// Lays out room for `wanted` handles, or as many as fit. False where none does.
// Pre: loops of at least three vertices, most_four_vertices together.
bool lay_out_four(const ShortLoops& loops, u32 wanted, u8* bytes, u64 size, ShortestScratch& scratch);

// Fills `found` with the shortest handles in order of length, ties in the order of the search; returns their number.
// There may be others as long as the last one. Handles longer than `limit` are not looked for: the closer it is, the
// quicker the search. `complete` tells whether the search came to its end before `work` was done (a unit takes .02 to
// .3 microseconds): else what it found are handles, but there may be shorter ones. Pre: laid out for these loops.
// O(n^7) where nothing is ruled out.
u32 shortest_of_four(const ShortLoops& loops, f64 limit, u64 work, ShortestScratch& scratch, bool& complete);

}  // namespace tpa
