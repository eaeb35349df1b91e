// SPDX-License-Identifier: MIT
// slab_bitmaps: a query of a box against many boxes at once, for detection (paper section 3). Each axis is divided into
// slabs of equal thickness. For each slab two sets, with a bit for each box, hold the boxes that begin in or before the
// slab, and the boxes that end in or behind it (range-encoded bitmaps, Chan & Ioannidis 1998). A box meets the query if
// it begins before the query ends and ends after the query begins, along all axes: an intersection of six sets, where
// comparisons of bounds would take six for each box.
#pragma once

#include "geometry/quantized_boxes.h"

namespace tpa {

struct SlabBitmaps {
  static constexpr u32 most = 256, of_word = 64;
  // About as many slabs as boxes, between these limits, so that few boxes begin or end in a slab.
  static constexpr u32 fewest_slabs = 16, most_slabs = 32;
  // The sets of 64 consecutive boxes, by slab and axis.
  struct Word {
    u64 begun[most_slabs][3], ended[most_slabs][3];
  };
  Word* word;
  u32 words = 0;
  u32 steps_of_slab = 0;  // the binary logarithm of a slab's steps of the frame
  QuantizedFrame frame;

  // For 1 to `most` boxes within `bounds`. `room` holds a Word for every 64 boxes, rounded up, and outlives the
  // sets.
  SlabBitmaps(Span<const Box> boxes, const Box& bounds, Word* room);
  SlabBitmaps(const SlabBitmaps&) = delete;

  // Writes a word of `met` for each 64 boxes, with bits for all boxes that meet q, and perhaps for boxes up to little
  // more than a slab away; a q beyond the bounds may get bits of other boxes too. O(boxes / 64).
  void meeting(const Box& q, u64* met) const;
};

}  // namespace tpa
