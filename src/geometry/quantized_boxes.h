// quantized_boxes: the boxes of the faces of a cluster, a byte for each bound: a quarter of the memory, and sixteen are
// compared at once.
//
// Bounds are counted in steps within a frame, rounded down: those of the boxes as well as those of what is searched
// for. Rounding down is monotone, so boxes that meet still do. What lies beyond the frame counts as its first or last
// step.
#pragma once

#include "geometry/flat_box.h"

namespace tpa {

struct ByteFrame {
  f32 low[3];  // step 0 begins there
  f32 steps;   // to a unit
};
inline constexpr u32 last_byte_step = 254;
// A box that no other meets begins behind the last step.
inline constexpr u8 no_byte_step = 255;

struct ByteBox {
  u8 low[4], high[4];  // three of them
};
inline constexpr ByteBox no_byte_box = {{no_byte_step, no_byte_step, no_byte_step}, {}};

struct ByteLanes {
  u8* low[3];
  u8* high[3];
};
// So many bytes behind the last box are read, too.
inline constexpr u32 bytes_in_lanes = 16;

// A cube round the box: what is flat may move.
ByteFrame frame_round(const FlatBox& box);
// Is the frame too narrow by more than twice for what is in the box by now?
inline bool is_outgrown(const ByteFrame& f, const FlatBox& box) {
  return extent_of(box) * f.steps > 2 * static_cast<f32>(last_byte_step);
}

ByteBox byte_box(const ByteFrame& f, const FlatBox& box);
inline void set_box(const ByteLanes& boxes, u32 i, const ByteBox& b) {
  for (u32 k = 0; k < 3; ++k) boxes.low[k][i] = b.low[k], boxes.high[k][i] = b.high[k];
}
// One bound along one axis of the boxes that the frame was made round, four to a vector; three vectors more are read.
// As many as there is room for.
void set_bounds(const ByteFrame& f, u32 axis, Span<const F4> bounds, u8* to, u32 room);

// Counts the boxes first .. last - 1 in another frame: each gets a step larger on either side, for what rounding took.
void change_frame(const ByteLanes& boxes, u32 first, u32 last, const ByteFrame& from, const ByteFrame& to);

// Which of the boxes first .. last - 1 meet q, of the first 64: a bit for each. One box or more.
u64 boxes_meeting(const ByteLanes& boxes, u32 first, u32 last, const ByteBox& q);

// Calls visit(i) for each of the boxes first .. last - 1 that meets q, until it answers false.
template <class Visit>
inline bool for_each_meeting(const ByteLanes& boxes, u32 first, u32 last, const ByteBox& q, Visit visit) {
  for (; first < last; first += 64)
    for (u64 met = boxes_meeting(boxes, first, last, q); met != 0; met &= met - 1)
      if (!visit(first + static_cast<u32>(__builtin_ctzll(met)))) return false;
  return true;
}

}  // namespace tpa
