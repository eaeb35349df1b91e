// SPDX-License-Identifier: MIT
// quantized_boxes: the boxes of a leaf's faces with a byte for each bound, for detection (paper section 3). A quarter
// of the memory of single precision, and sixteen boxes are compared at once.
//
// Bounds are counted in steps within a frame and rounded down, in the boxes as well as in a query. Rounding down is
// monotone, so boxes that meet still do. Bounds beyond the frame count as its first or last step.
#pragma once

#include "geometry/box.h"

namespace tpa {

struct QuantizedFrame {
  f32 low[3];  // where step 0 begins
  f32 steps;   // per unit of length
};
inline constexpr u32 last_byte_step = 254;
// Boxes that meet no other begin behind the last step.
inline constexpr u8 no_byte_step = 255;

struct QuantizedBox {
  u8 low[4], high[4];  // three axes; the fourth byte is never compared
};
inline constexpr QuantizedBox no_byte_box = {{no_byte_step, no_byte_step, no_byte_step}, {}};

// Many boxes, with an array for each bound.
struct QuantizedLanes {
  u8* low[3];
  u8* high[3];
};
// Reads go up to so many bytes beyond the last box.
inline constexpr u32 bytes_in_lanes = 16;

// The cube round the box: a flat box gets a frame of some height too, since its faces may move.
QuantizedFrame frame_round(const Box& box);
// Has the box grown to more than twice the frame?
inline bool is_outgrown(const QuantizedFrame& f, const Box& box) {
  return extent_of(box) * f.steps > 2 * static_cast<f32>(last_byte_step);
}

QuantizedBox byte_box(const QuantizedFrame& f, const Box& box);
inline void set_box(const QuantizedLanes& boxes, u32 i, const QuantizedBox& b) {
  for (u32 k = 0; k < 3; ++k) boxes.low[k][i] = b.low[k], boxes.high[k][i] = b.high[k];
}
// Writes one bound along one axis of boxes within the frame, `room` of them at most; `bounds` has four to a vector. Up
// to three vectors behind the last are read.
void set_bounds(const QuantizedFrame& f, u32 axis, Span<const F4> bounds, u8* to, u32 room);

// Converts the boxes first .. last - 1 to another frame. Each box grows by a step on either side, against the rounding.
void change_frame(const QuantizedLanes& boxes, u32 first, u32 last, const QuantizedFrame& from,
                  const QuantizedFrame& to);

// Bit i: box first + i meets q, for the first 64 of the boxes first .. last - 1. Pre: first < last.
u64 boxes_meeting(const QuantizedLanes& boxes, u32 first, u32 last, const QuantizedBox& q);

// Calls visit(i) in ascending order for the boxes first .. last - 1 that meet q, until a call returns false; false
// then.
template <class Visit>
inline bool for_each_meeting(const QuantizedLanes& boxes, u32 first, u32 last, const QuantizedBox& q, Visit visit) {
  for (; first < last; first += 64)
    for (u64 met = boxes_meeting(boxes, first, last, q); met != 0; met &= met - 1)
      if (!visit(first + static_cast<u32>(__builtin_ctzll(met)))) return false;
  return true;
}

}  // namespace tpa
