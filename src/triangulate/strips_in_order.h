// strips_in_order: the shortest closed strips between two loops, in order of length (docs/handles.md).
//
// Every strip has one start (triangulate/strip.h). Bounds tell which starts are promising; of these the length of the
// shortest strip is found. From the most promising start on, the lattice paths are followed step by step, with a table
// of the least lengths to go, as long as they can be among the best. Starts whose shortest strip is longer than as many
// as are wanted need no table. Lengths that differ by rounding only are taken for equal. Whether a face is free is
// asked only if it may be part of a strip that is short enough.
#pragma once

#include "triangulate/best_list.h"
#include "triangulate/face_filter.h"
#include "triangulate/strip.h"

namespace tpa {

// A strip: from edge (x_0, y_start); its steps are in words of their own, bit set for a step on x.
struct OrderedStrip {
  f64 length = 0;
  u32 start = 0, word = 0;  // which one
};
// A step of the search.
struct StripStep {
  f64 spent = 0;  // with the edge arrived at
  u16 i = 0, j = 0;
  u16 column = 0;  // in which all steps on y so far are; `bent` if in several: no column of most_ordered_steps
  u8 option = 0;
};

struct StripOrder {
  BestList<OrderedStrip> best;
  u32* words = nullptr;  // `per_strip` for each strip, and for the one in hand
  u32 per_strip = 0;
  f64 *start_length = nullptr, *column = nullptr;
  u8* measured = nullptr;  // is start_length the length of the shortest strip? Else that is longer
  f64* to_go = nullptr;    // from i steps on x, j on y: i + j (p + 1)
  StripStep* step = nullptr;
  // Bits i q + j, for the faces over the edge from x_i, apex y_j, and over that to y_j, apex x_i. What has not been
  // asked about is taken to be free.
  u32 *x_free = nullptr, *y_free = nullptr, *x_asked = nullptr, *y_asked = nullptr;
};

// Lays out room for loops of p and q vertices and at most `wanted` strips, or as many as fit. False where none does,
// and where p + q > most_ordered_steps. Pre: scratch aligned for f64.
inline constexpr u32 most_ordered_steps = 65000;
bool lay_out_strip_order(u32 p, u32 q, u32 wanted, u8* scratch, u64 scratch_bytes, StripOrder& order);
// Finds the shortest strips, as many as there is room for, without those that have a face that is not free. Ties in the
// order of the search, which does not depend on how many are wanted. O(p q), and as much for each start that matters.
void find_strips(const StripLoops& loops, const FaceFilter& filter, StripOrder& order);
// Pre: number < order.best.count.
void write_strip(const StripLoops& loops, const StripOrder& order, u32 number, FaceCorners* out);

}  // namespace tpa
