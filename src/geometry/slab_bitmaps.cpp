// SPDX-License-Identifier: MIT
#include "geometry/slab_bitmaps.h"

#include <string.h>

namespace tpa {

SlabBitmaps::SlabBitmaps(Span<const Box> boxes, const Box& bounds, Word* room)
    : word(room), frame(frame_round(bounds)) {
  u32 slabs = fewest_slabs;
  while (slabs < min_of(boxes.size, most_slabs)) slabs *= 2;
  while (slabs << steps_of_slab <= last_byte_step) ++steps_of_slab;
  for (u32 first = 0; first < boxes.size; first += of_word) {
    Word& w = word[words++];
    memset(w.begun, 0, slabs * sizeof *w.begun);
    memset(w.ended, 0, slabs * sizeof *w.ended);
    for (u32 i = first; i < min_of(boxes.size, first + of_word); ++i) {
      const QuantizedBox b = byte_box(frame, boxes[i]);
      const u64 bit = u64{1} << (i - first);
      for (u32 k = 0; k < 3; ++k) {
        w.begun[b.low[k] >> steps_of_slab][k] |= bit;
        w.ended[b.high[k] >> steps_of_slab][k] |= bit;
      }
    }
    for (u32 i = 1; i < slabs; ++i)
      for (u32 k = 0; k < 3; ++k) {
        w.begun[i][k] |= w.begun[i - 1][k];
        w.ended[slabs - 1 - i][k] |= w.ended[slabs - i][k];
      }
  }
}

void SlabBitmaps::meeting(const Box& q, u64* met) const {
  const QuantizedBox b = byte_box(frame, q);
  for (u32 i = 0; i < words; ++i) {
    const auto &begun = word[i].begun, &ended = word[i].ended;
    const auto by = [&](u32 k) { return begun[b.high[k] >> steps_of_slab][k] & ended[b.low[k] >> steps_of_slab][k]; };
    met[i] = by(0) & by(1) & by(2);
  }
}

}  // namespace tpa
