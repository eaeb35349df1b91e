#include "box_rows.h"

namespace tpa {

void clear(BoxRow& row) {
  for (u32 i = 0; i < BoxRow::size; ++i) set_box(row, i, empty_box);
}

Box bounds_of(const BoxRow& row) {
  Box b;
  for (u32 k = 0; k < 3; ++k) {
    const F4 low = min4(load4(row.low[k]), load4(row.low[k] + 4)), high = max4(load4(row.high[k]), load4(row.high[k] + 4));
    b.low[k] = min_of(min_of(low[0], low[1]), min_of(low[2], low[3]));
    b.high[k] = max_of(max_of(high[0], high[1]), max_of(high[2], high[3]));
  }
  return b;
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

}  // namespace tpa
