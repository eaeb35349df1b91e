// slabs: which of some boxes meet another one, told for all of them at once: for each bound along each axis, sets of
// those that have it in or before a slab, or in or behind one, a bit for each box (range-encoded bitmaps, Chan and
// Ioannidis 1998). What meets a box is what begins before it ends and ends after it begins, along all axes: six sets of
// which the bits that they share are left, where comparing bounds takes six comparisons for each box.
#pragma once

#include "byte_boxes.h"

namespace tpa {

struct SlabSets {
  static constexpr u32 most = 256, of_word = 64;
  // Within what bounds all boxes: about as many as these are, so that each begins and ends in few of them.
  static constexpr u32 fewest_slabs = 16, most_slabs = TPA_SMALL ? 16 : 128;
  u32 words = 0;         // of a set
  u32 steps_of_slab = 0;  // 2 to the power of this
  ByteFrame frame;
  // One word of each set: by slab and axis.
  struct Word {
    u64 begun[most_slabs][3], ended[most_slabs][3];
  } word[most / of_word];

  // Of up to so many boxes, one or more; `bounds` is what is round all.
  SlabSets(Span<const FlatBox> boxes, const FlatBox& bounds);
  SlabSets(const SlabSets&) = delete;

  // Sixty-four of the boxes after each other have a word of `met` each: a bit for each that q meets, and perhaps for
  // some that are not much more than a slab away. O(boxes / 64).
  void meeting(const FlatBox& q, u64* met) const;
};

}  // namespace tpa
