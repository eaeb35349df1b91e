// shortest: the handles of least total edge length between three or four polygons of up to 15 vertices, in order
// (design 4.4).
//
// Take one polygon, D, out. Its star is a closed walk around it (round_walk.h); what is left of the handle are strips
// that begin at a base (short_base.h), for which the shortest are known. A search through all bases, starts of the
// walk, walks and strips, depth first, follows only what can still be among the best: it knows the least length to go,
// and that is exact as far as inner triangles are free. The tables admit some handles with an edge twice, where polygons
// are squeezed into a slit; these are dropped when met.
#pragma once

#include "short_base.h"

namespace tpa {

inline constexpr u32 most_short_faces = most_short_vertices + 2 * 4 - 4;

struct ShortHandle {
  f64 length = 0;  // of all edges that are not a polygon's
  u8 face[most_short_faces][3] = {};
};

// A step of the search: what has been decided last.
struct ShortStep {
  enum class Phase : u8 { walk, tail, middle, strip };
  Phase phase = Phase::walk;
  WalkState walk;         // Phase::walk
  u8 piece = 0;           // the others: which piece, and the steps left on its polygons, or for the tail taken
  u8 i = 0, j = 0;
  StripRule rule = StripRule::any;
  u8 option = 0;          // the next one to try
  u8 faces = 0;           // made so far
  f64 spent = 0;          // all but what is to go on the present piece
};

// What is left to do beside the walk: strips, and for a row the tail and the middle.
struct ShortPiece {
  ShortStep::Phase phase = ShortStep::Phase::strip;
  u8 strip = 0;
  u8 i = 0, j = 0;
};

// Answers for inner triangles, two bits for each and each way round: 4 triples of polygons, corners on each of them.
struct InnerMemory {
  static constexpr u32 words = (4 * most_steps * most_steps * most_steps * 2 + 31) / 32;
  u32 asked[words], free[words];
};

struct ShortestScratch {
  static constexpr u32 depth = most_short_faces + 2, pieces = 4;  // a step makes a face at least, but the first
  BaseScratch base;
  WalkTable table;
  ShortStep step[depth];
  ShortPiece piece[pieces];
  u8 left_at[3], entered_at[3];  // by the walk, for each track
  u8 face[most_short_faces][3];
  InnerMemory inner;
};

// Fills `best` with the shortest handles in order of length, ties in the order of the search; returns their number.
// Handles longer than `limit` are not looked for: the closer it is, the quicker the search. `complete` tells whether
// the search came to its end before `work` was done (a unit takes .02 to .3 microseconds): else what it found are
// handles, but there may be shorter ones.
// Pre: 3 or 4 loops of 3 to 15 vertices, `best` not empty. O(n^6) for k = 3 and O(n^7) for k = 4 where nothing is ruled
// out.
u32 shortest_handles(const ShortLoops& loops, f64 limit, u64 work, ShortestScratch& scratch, Span<ShortHandle> best,
                     bool& complete);

}  // namespace tpa
