// SPDX-License-Identifier: MIT
#include "geometry/box.h"

#include "base/simd.h"

namespace tpa {

namespace {

// The nearest float is off by at most a relative 2^-24, and the correction by as much again, so 2^-22 is ample. The
// exact range keeps all numbers normal.
constexpr f32 outward = 0x1p-22f;

F4 nearest(const Vec3& p) {
#if defined(TPA_VECTORS)
  return nearest4(load2(&p.x), all2(p.z));
#else
  return F4{static_cast<f32>(p.x), static_cast<f32>(p.y), static_cast<f32>(p.z), 0};
#endif
}

}  // namespace

// Rounding is monotone, so the corners may be rounded first.
Box box_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const F4 p = nearest(a), q = nearest(b), r = nearest(c);
  const F4 low = min4(p, min4(q, r)), high = max4(p, max4(q, r));
  const F4 below = low - outward * abs_of(low), above = high + outward * abs_of(high);
  return box_between(below, above);
}

}  // namespace tpa
