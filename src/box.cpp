#include "box.h"

#include <string.h>

#include "lanes.h"

namespace tpa {

namespace {

// The nearest float is off by at most 2^-24 of its size, and the correction by as much again, so this is ample. The
// exact range keeps everything normal.
constexpr f32 outward = 0x1p-22f;

F4 nearest(const D2& xy, f64 z) {
  return F4{static_cast<f32>(xy[0]), static_cast<f32>(xy[1]), static_cast<f32>(z), 0};
}

}  // namespace

Box box_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const D2 p = load2(&a.x), q = load2(&b.x), r = load2(&c.x);
  const F4 low = nearest(min2(p, min2(q, r)), min_of(a.z, min_of(b.z, c.z)));
  const F4 high = nearest(max2(p, max2(q, r)), max_of(a.z, max_of(b.z, c.z)));
  const F4 below = low - outward * abs4(low), above = high + outward * abs4(high);
  Box box;
  memcpy(box.low, &below, sizeof box.low);
  memcpy(box.high, &above, sizeof box.high);
  return box;
}

}  // namespace tpa
