// SPDX-License-Identifier: MIT
// strips_in_order: the shortest closed strips between two loops, in order of length (docs/handles.md).
//
// Every strip has one start (triangulate/strip.h). Lower bounds tell the promising starts, whose shortest strips are
// then measured. From the most promising start on, lattice paths are followed step by step as long as they can be among
// the best, with a table of the least lengths to go. A start whose shortest strip is longer than as many strips as are
// wanted needs no table. Lengths that differ by rounding only count as equal. The caller is asked about a face only if
// the face may be part of a strip that is short enough.
#pragma once

#include "base/meter.h"
#include "triangulate/best_list.h"
#include "triangulate/face_filter.h"
#include "triangulate/strip.h"

namespace tpa {

// A strip from edge (x_0, y_start). Its steps are bits, set for a step on x, in word list number `word`.
struct OrderedStrip {
  f64 length = 0;
  u32 start = 0, word = 0;
};
// A step of the search.
struct StripStep {
  f64 spent = 0;  // including the edge at (i, j)
  u16 i = 0, j = 0;
  u16 column = 0;  // of all steps on y so far; `bent`, for several columns
  u8 option = 0;
};

struct StripOrder {
  BestList<OrderedStrip> best;
  u32* words = nullptr;  // `per_strip` for each strip, and for the strip in hand
  u32 per_strip = 0;
  f64 *start_length = nullptr, *column = nullptr;
  u8* measured = nullptr;  // is start_length exact? Else it is a lower bound
  f64* to_go = nullptr;    // least length after i steps on x and j on y, at i + j (p + 1)
  StripStep* step = nullptr;
  // Bits i q + j: for the face over the edge from x_i with apex y_j, and over the edge to y_j with apex x_i. Faces
  // count as free until the caller is asked.
  u32 *x_free = nullptr, *y_free = nullptr, *x_asked = nullptr, *y_asked = nullptr;
  Meter* meter = nullptr;
};

// Lays out room for loops of p and q vertices and for `wanted` strips, or as many as fit. False where no strip fits.
// Pre: p + q < 2^16 - 2, since steps are counted in 16 bits; scratch aligned for f64.
bool lay_out_strip_order(u32 p, u32 q, u32 wanted, u8* scratch, u64 scratch_bytes, StripOrder& order);
// Finds the shortest strips of free faces, as many as have room. Ties come in the order of the search, whatever number
// is wanted; fewer if the meter stops. O(p q), and as much for each start that matters.
void find_strips(const StripLoops& loops, const FaceFilter& filter, StripOrder& order);
// Pre: number < order.best.count.
void write_strip(const StripLoops& loops, const StripOrder& order, u32 number, FaceCorners* out);

}  // namespace tpa
