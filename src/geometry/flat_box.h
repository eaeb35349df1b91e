// flat_box: boxes of single-precision numbers, one by one and in lanes.
#pragma once

#include "base/simd.h"

namespace tpa {

// Flat: in the units of the clusters, in which the mesh lies within -1 .. 1. A Box (geometry/box.h) is one in those of
// the mesh. Along three axes; a fourth number of each, so that they are read and written at once.
struct FlatBox {
  f32 low[4], high[4];
};
#if defined(TPA_VECTORS)
inline FlatBox box_between(const F4& low, const F4& high) {
  FlatBox b;
  store4(b.low, low);
  store4(b.high, high);
  return b;
}
inline FlatBox united(const FlatBox& a, const FlatBox& b) {
  return box_between(min4(load4(a.low), load4(b.low)), max4(load4(a.high), load4(b.high)));
}
#else
inline FlatBox box_between(const F4& low, const F4& high) {
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}
inline FlatBox united(const FlatBox& a, const FlatBox& b) {
  FlatBox all;
  for (u32 i = 0; i < 3; ++i) all.low[i] = min_of(a.low[i], b.low[i]), all.high[i] = max_of(a.high[i], b.high[i]);
  return all;
}
#endif
// Along the axis where it is largest.
inline f32 extent_of(const FlatBox& b) {
  return max_of(b.high[0] - b.low[0], max_of(b.high[1] - b.low[1], b.high[2] - b.low[2]));
}
inline bool boxes_meet(const FlatBox& a, const FlatBox& b) {
#if defined(TPA_VECTORS)
  return (bits_of(at_most(load4(a.low), load4(b.high)) & at_most(load4(b.low), load4(a.high))) & 7) == 7;
#else
  return (a.low[0] <= b.high[0]) & (b.low[0] <= a.high[0]) & (a.low[1] <= b.high[1]) & (b.low[1] <= a.high[1]) &
         (a.low[2] <= b.high[2]) & (b.low[2] <= a.high[2]);
#endif
}

struct BoxLanes {
  f32* low[3];
  f32* high[3];
};

struct ConstBoxLanes {
  const f32* low[3];
  const f32* high[3];
};
inline ConstBoxLanes lanes_of(const BoxLanes& b) {
  return {{b.low[0], b.low[1], b.low[2]}, {b.high[0], b.high[1], b.high[2]}};
}

// The same box in all lanes.
struct BroadBox {
  F4 low[3], high[3];
};
inline BroadBox broad(const FlatBox& b) {
  return {{all4(b.low[0]), all4(b.low[1]), all4(b.low[2])}, {all4(b.high[0]), all4(b.high[1]), all4(b.high[2])}};
}
// Which of the boxes at .. at + 3 meet b.
inline I4 lanes_meeting(const ConstBoxLanes& boxes, u32 at, const BroadBox& b) {
  return at_most(load4(boxes.low[0] + at), b.high[0]) & at_most(b.low[0], load4(boxes.high[0] + at)) &
         at_most(load4(boxes.low[1] + at), b.high[1]) & at_most(b.low[1], load4(boxes.high[1] + at)) &
         at_most(load4(boxes.low[2] + at), b.high[2]) & at_most(b.low[2], load4(boxes.high[2] + at));
}

// Calls visit(i) for each of the boxes first .. last - 1 that meets q, until it answers false. Which ones do is noted
// before any is visited: where they lie among four is as good as random.
template <class Visit>
inline bool for_each_meeting(const ConstBoxLanes& boxes, u32 first, u32 last, const BroadBox& q, Visit visit) {
  for (; first < last; first += 64) {
    u64 met = 0;
    for (u32 i = 0; i < 64 && first + i < last; i += 4)
      met |= u64{first_bits_of(lanes_meeting(boxes, first + i, q), last - first - i)} << i;
    for (; met != 0; met &= met - 1)
      if (!visit(first + static_cast<u32>(__builtin_ctzll(met)))) return false;
  }
  return true;
}

}  // namespace tpa
