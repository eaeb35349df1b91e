#include "box.h"

#include <string.h>

#include "lanes.h"

namespace tpa {

namespace {

// The nearest float is off by at most 2^-24 of its size, and the correction by as much again, so this is ample. The
// exact range keeps everything normal.
constexpr f32 outward = 0x1p-22f;

F4 nearest(const Vec3& p) {
#if defined(TPA_SSE2)
  const __m128 xy = _mm_cvtpd_ps(_mm_loadu_pd(&p.x)), z = _mm_cvtpd_ps(_mm_load_sd(&p.z));
  return reinterpret_cast<F4>(_mm_movelh_ps(xy, z));
#else
  return F4{static_cast<f32>(p.x), static_cast<f32>(p.y), static_cast<f32>(p.z), 0};
#endif
}

}  // namespace

// The nearest of the least is the least of the nearest.
Box box_of(const Vec3& a, const Vec3& b, const Vec3& c) {
  const F4 p = nearest(a), q = nearest(b), r = nearest(c);
  const F4 low = min4(p, min4(q, r)), high = max4(p, max4(q, r));
  const F4 below = low - outward * abs4(low), above = high + outward * abs4(high);
  Box box;
  memcpy(box.low, &below, sizeof box.low);
  memcpy(box.high, &above, sizeof box.high);
  return box;
}

}  // namespace tpa
