// SPDX-License-Identifier: MIT
// box: boxes in single precision, of triangles, one by one and four at a time. Half the memory of doubles, and for
// culling only: rounding goes outward or is monotone, so boxes of points that meet do meet (paper section 3).
#pragma once

#include "base/simd.h"
#include "base/vec3.h"

namespace tpa {

// In the units of the mesh (box_of), or of the face tree, where the mesh lies within -1 .. 1 (detect/face_tree.h).
// Three axes; a fourth number of any value, so that a bound is read and written at once.
struct Box {
  f32 low[4], high[4];
};

// The box of a triangle, rounded outward.
Box box_of(const Vec3& a, const Vec3& b, const Vec3& c);

// The box of no point: meets nothing, and united with another box it gives the other.
inline constexpr Box empty_box = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};

#if defined(TPA_VECTORS)
inline Box box_between(const F4& low, const F4& high) {
  Box b;
  store4(b.low, low);
  store4(b.high, high);
  return b;
}
inline Box united(const Box& a, const Box& b) {
  return box_between(min4(load4(a.low), load4(b.low)), max4(load4(a.high), load4(b.high)));
}
#else
inline Box box_between(const F4& low, const F4& high) {
  return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
}
inline Box united(const Box& a, const Box& b) {
  Box all;
  for (u32 i = 0; i < 3; ++i) all.low[i] = min_of(a.low[i], b.low[i]), all.high[i] = max_of(a.high[i], b.high[i]);
  return all;
}
#endif
// The length of the longest side.
inline f32 extent_of(const Box& b) {
  return max_of(b.high[0] - b.low[0], max_of(b.high[1] - b.low[1], b.high[2] - b.low[2]));
}
// Closed boxes: touching counts.
inline bool boxes_meet(const Box& a, const Box& b) {
#if defined(TPA_VECTORS)
  return (bits_of((load4(a.low) <= load4(b.high)) & (load4(b.low) <= load4(a.high))) & 7) == 7;
#else
  return (a.low[0] <= b.high[0]) & (b.low[0] <= a.high[0]) & (a.low[1] <= b.high[1]) & (b.low[1] <= a.high[1]) &
         (a.low[2] <= b.high[2]) & (b.low[2] <= a.high[2]);
#endif
}

// Many boxes, with an array for each bound.
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
inline BroadBox broad(const Box& b) {
  return {{all4(b.low[0]), all4(b.low[1]), all4(b.low[2])}, {all4(b.high[0]), all4(b.high[1]), all4(b.high[2])}};
}
// A mask of the boxes at .. at + 3 that meet b.
inline I4 lanes_meeting(const ConstBoxLanes& boxes, u32 at, const BroadBox& b) {
  return (load4(boxes.low[0] + at) <= b.high[0]) & (b.low[0] <= load4(boxes.high[0] + at)) &
         (load4(boxes.low[1] + at) <= b.high[1]) & (b.low[1] <= load4(boxes.high[1] + at)) &
         (load4(boxes.low[2] + at) <= b.high[2]) & (b.low[2] <= load4(boxes.high[2] + at));
}

}  // namespace tpa
