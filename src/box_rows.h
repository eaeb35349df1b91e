// box_rows: boxes side by side, eight to a row and eight rows to a block, so that one search asks many at once.
#pragma once

#include "box.h"
#include "flat_box.h"

namespace tpa {

struct BoxRow {
  static constexpr u32 size = 8, block = 64;  // boxes of a row, and of a block of rows
  f32 low[3][size], high[3][size];
};

// Nothing meets an empty box, and one that is widened by another becomes that.
void clear(BoxRow& row);
inline void set_box(BoxRow& row, u32 i, const Box& box) {
TPA_UNROLL(3)
  for (u32 k = 0; k < 3; ++k) row.low[k][i] = box.low[k], row.high[k][i] = box.high[k];
}
inline void widen_box(BoxRow& row, u32 i, const Box& box) {
TPA_UNROLL(3)
  for (u32 k = 0; k < 3; ++k) {
    row.low[k][i] = min_of(row.low[k][i], box.low[k]);
    row.high[k][i] = max_of(row.high[k][i], box.high[k]);
  }
}
inline Box box_at(const BoxRow& row, u32 i) {
  Box b;
  for (u32 k = 0; k < 3; ++k) b.low[k] = row.low[k][i], b.high[k] = row.high[k][i];
  return b;
}

// What bounds all boxes of a row.
Box bounds_of(const BoxRow& row);

// Which of the boxes meet q: a bit for each.
u32 boxes_meeting(const BoxRow& row, const BroadBox& q);
// The same for eight rows from `rows` on, whose bounds are the boxes of another one. All are noted before any is looked
// at: where rows and boxes end that meet q is as good as random.
u64 boxes_meeting(const BoxRow* rows, const BoxRow& bounds, const BroadBox& q);

// A block of boxes, as far as there are any.
struct BoxBlock {
  u32 count = 0;
  BoxRow row[BoxRow::block / BoxRow::size], bounds;

  BoxBlock() { clear(bounds); }
  void add(const Box& box);
  u64 meeting(const BroadBox& q) const { return boxes_meeting(row, bounds, q); }
};

}  // namespace tpa
