// lanes: four single-precision numbers at a time, or two of double precision. Comparisons, minima and maxima only where
// a result depends on them, so the bits are those of a plain loop on every platform.
#pragma once

#include <string.h>

#include "fp.h"

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace tpa {

using F4 = f32 __attribute__((vector_size(16)));
using D2 = f64 __attribute__((vector_size(16)));
using I4 = i32 __attribute__((vector_size(16)));

inline F4 load4(const f32* p) {
  F4 v;
  memcpy(&v, p, sizeof v);
  return v;
}
inline void store4(f32* p, F4 v) { memcpy(p, &v, sizeof v); }
inline D2 load2(const f64* p) {
  D2 v;
  memcpy(&v, p, sizeof v);
  return v;
}
inline void store2(f64* p, D2 v) { memcpy(p, &v, sizeof v); }
inline D2 all2(f64 x) { return D2{x, x}; }
inline D2 min2(D2 a, D2 b) { return a < b ? a : b; }
inline D2 max2(D2 a, D2 b) { return a > b ? a : b; }
inline F4 all4(f32 x) { return F4{x, x, x, x}; }
inline F4 min4(F4 a, F4 b) { return a < b ? a : b; }
inline F4 max4(F4 a, F4 b) { return a > b ? a : b; }
inline F4 abs4(F4 a) {
  constexpr i32 magnitude_bits = 0x7FFFFFFF;
  return reinterpret_cast<F4>(reinterpret_cast<I4>(a) & magnitude_bits);
}
inline F4 root4(F4 a) {
#if defined(__SSE2__)
  return reinterpret_cast<F4>(_mm_sqrt_ps(reinterpret_cast<__m128>(a)));
#else
  return F4{root_of(a[0]), root_of(a[1]), root_of(a[2]), root_of(a[3])};
#endif
}

// Lanes 0 .. n-1 are set.
inline I4 first_lanes(u32 n) {
  const i32 k = static_cast<i32>(n);
  return I4{0, 1, 2, 3} < I4{k, k, k, k};
}
// Bit i: lane i of a mask is set.
inline u32 bits_of(I4 mask) {
#if defined(__SSE2__)
  return static_cast<u32>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  const I4 bits = mask & I4{1, 2, 4, 8};
  return static_cast<u32>(bits[0] | bits[1] | bits[2] | bits[3]);
#endif
}
inline f32 least_of(F4 v) { return min_of(min_of(v[0], v[1]), min_of(v[2], v[3])); }
inline f32 largest_of(F4 v) { return max_of(max_of(v[0], v[1]), max_of(v[2], v[3])); }

// Rows become columns.
inline void transpose(F4& a, F4& b, F4& c, F4& d) {
  const F4 ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5), ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const F4 cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5), cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
  c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
  d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

}  // namespace tpa
