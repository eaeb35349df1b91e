// box: the boxes of triangles, in single precision.
#pragma once

#include "vec3.h"

namespace tpa {

// Bounds rounded outward to single precision: half the memory, and never too small.
struct Box {
  f32 low[3], high[3];
};
Box box_of(const Vec3& a, const Vec3& b, const Vec3& c);
inline bool boxes_meet(const Box& a, const Box& b) {
  return (a.low[0] <= b.high[0]) & (b.low[0] <= a.high[0]) & (a.low[1] <= b.high[1]) & (b.low[1] <= a.high[1]) &
         (a.low[2] <= b.high[2]) & (b.low[2] <= a.high[2]);
}

// No box: what is not there.
inline constexpr Box empty_box = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
inline bool is_empty(const Box& b) { return b.low[0] > b.high[0]; }

inline f32 extent_of(const Box& b) {
  return max_of(b.high[0] - b.low[0], max_of(b.high[1] - b.low[1], b.high[2] - b.low[2]));
}

inline Box united(const Box& a, const Box& b) {
  return {{min_of(a.low[0], b.low[0]), min_of(a.low[1], b.low[1]), min_of(a.low[2], b.low[2])},
          {max_of(a.high[0], b.high[0]), max_of(a.high[1], b.high[1]), max_of(a.high[2], b.high[2])}};
}

}  // namespace tpa
