// strip_order: all closed strips between two short loops, in order of length (design 4.4: "the handles
// outside the database in order of length").
//
// A best-first search along the lattice paths of strip.h. The length still to go is known exactly from a
// table, so that only beginnings of strips that will come out are followed, one new one for each step of each
// strip given.
#pragma once

#include "face_filter.h"
#include "strip.h"

namespace tpa {

// The beginning of a strip: start edge, steps so far (bit t set for a step on x), and the total it will come
// to.
struct StripBeginning {
  f64 total = 0;  // with the shortest way to go
  f64 sofar = 0;
  u32 word = 0;
  u8 start = 0, i = 0, j = 0;
  bool straight = false;  // all its steps on y are its last ones
};

struct StripOrderScratch {
  static constexpr u32 side = 15, capacity = 4096;
  f64 distance[side][side];
  bool x_free[side][side], y_free[side][side];  // over the edge from x_i, apex y_j; over that to y_j, x_i
  // To go from x-step i, y-step j; `bent` where steps on y have been interrupted, else `straight`.
  f64 bent[side][side + 1][side + 1], straight[side][side + 1][side + 1];
  StripBeginning heap[capacity];
  u32 count;
};

// Pre: loops of 3 to 15 vertices. Strips with a face that is not free are left out.
void begin_strip_order(const StripLoops& loops, const FaceFilter& filter, StripOrderScratch& scratch);
// The next strip in order of length, ties by the steps. False when all are given.
bool next_strip(const StripLoops& loops, StripOrderScratch& scratch, HandleFace* out);

}  // namespace tpa
