// box: the boxes of triangles, in single precision.
#pragma once

#include "base/vec3.h"
#include "geometry/flat_box.h"

namespace tpa {

// Bounds rounded outward to single precision: half the memory, and never too small.
using Box = FlatBox;

Box box_of(const Vec3& a, const Vec3& b, const Vec3& c);

// No box: what is not there.
inline constexpr Box empty_box = {{FLT_MAX, FLT_MAX, FLT_MAX}, {-FLT_MAX, -FLT_MAX, -FLT_MAX}};
inline bool is_empty(const Box& b) { return b.low[0] > b.high[0]; }

}  // namespace tpa
