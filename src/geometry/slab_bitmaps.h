// slab_bitmaps: which of some boxes meet another one, told for all of them at once: for each bound along each axis,
// sets of those that have it in or before a slab, or in or behind one, a bit for each box (range-encoded bitmaps, Chan
// and Ioannidis 1998). What meets a box is what begins before it ends and ends after it begins, along all axes: six
// sets of which the bits that they share are left, where comparing bounds takes six comparisons for each box. The slabs
// of a frame are all as thick; those of clusters (sheets, pairs) are another matter.
#pragma once

#include "geometry/quantized_boxes.h"

namespace tpa {

struct SlabSets {
  static constexpr u32 most = 256, of_word = 64;
  // Within what bounds all boxes: about as many slabs as boxes, between these, so that few begin or end in each.
  static constexpr u32 fewest_slabs = 16, most_slabs = TPA_SMALL ? 16 : 128;
  // What sets say of sixty-four of the boxes after each other: by slab and axis.
  struct Word {
    u64 begun[most_slabs][3], ended[most_slabs][3];
  };
  Word* word;
  u32 words = 0;
  u32 steps_of_slab = 0;  // a slab has 2 to the power of so many steps of the frame
  ByteFrame frame;

  // Of up to so many boxes, one or more; `bounds` is what is round all. There is room for a word for each sixty-four.
  SlabSets(Span<const FlatBox> boxes, const FlatBox& bounds, Word* room);
  SlabSets(const SlabSets&) = delete;

  // Writes a word of `met` for each sixty-four boxes: a bit for each that q meets, and perhaps for some that are not
  // much more than a slab away; where q lies beyond the bounds, for others. O(boxes / 64).
  void meeting(const FlatBox& q, u64* met) const;
};

}  // namespace tpa
