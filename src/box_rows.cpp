#include "box_rows.h"

namespace tpa {

void clear(BoxRow& row) {
  for (u32 i = 0; i < BoxRow::size; ++i) set_box(row, i, empty_box);
}

Box bounds_of(const BoxRow& row) {
  Box all = empty_box;
  for (u32 i = 0; i < BoxRow::size; ++i) all = united(all, box_at(row, i));
  return all;
}

u32 boxes_meeting(const BoxRow& row, const BroadBox& q) {
  const ConstBoxLanes boxes{{row.low[0], row.low[1], row.low[2]}, {row.high[0], row.high[1], row.high[2]}};
  return bits_of(lanes_meeting(boxes, 0, q)) | bits_of(lanes_meeting(boxes, 4, q)) << 4;
}

u64 boxes_meeting(const BoxRow* rows, const BoxRow& bounds, const BroadBox& q) {
  u64 met = 0;
  for (u32 near = boxes_meeting(bounds, q); near != 0; near &= near - 1) {
    const u32 row = static_cast<u32>(__builtin_ctz(near));
    met |= u64{boxes_meeting(rows[row], q)} << BoxRow::size * row;
  }
  return met;
}

void BoxBlock::add(const Box& box) {
  const u32 in_row = count % BoxRow::size, at = count / BoxRow::size;
  // It is read as a whole.
  if (in_row == 0) clear(row[at]);
  set_box(row[at], in_row, box);
  widen_box(bounds, at, box);
  ++count;
}

}  // namespace tpa
