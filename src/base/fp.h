// fp: IEEE double operations whose bits are the same everywhere (promise P6).
// The predicates and every tie-break rest on them, so a compiler mode that breaks them is refused here.
#pragma once

#include <float.h>

#include "base/base.h"

#if defined(__FAST_MATH__) || (defined(_MSC_VER) && defined(_M_FP_FAST))
#error "topoadapt needs IEEE arithmetic: compile without fast-math"
#endif
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0
#error "topoadapt needs double operations in double precision (on x86-32: -msse2 -mfpmath=sse)"
#endif

namespace tpa {

static_assert(sizeof(f64) == 8 && DBL_MANT_DIG == 53 && DBL_MAX_EXP == 1024, "IEEE 754 binary64");

// Magnitudes between which products of four differences neither overflow nor lose a bit to underflow,
// even when the host flushes subnormal numbers to zero. Zero itself is allowed.
inline constexpr f64 smallest_magnitude = 0x1p-100;
inline constexpr f64 largest_magnitude = 0x1p100;

// Clears the sign bit: one instruction, no library.
constexpr f64 abs_of(f64 x) { return __builtin_fabs(x); }

inline f64 square_root(f64 x) { return __builtin_sqrt(x); }
constexpr f32 magnitude(f32 x) { return __builtin_fabsf(x); }
// The same bits either way; without the instruction there is no second library function to ask for.
inline f32 root_of(f32 x) {
#if defined(__SSE2__)
  return __builtin_sqrtf(x);
#else
  return static_cast<f32>(square_root(static_cast<f64>(x)));
#endif
}

// In the range that exact arithmetic needs? False for NaN and infinities as well.
constexpr bool in_exact_range(f64 x) {
  const f64 m = abs_of(x);
  return x == 0 || (m >= smallest_magnitude && m <= largest_magnitude);
}

// What the library computes itself may fall below the range (a mean of numbers near zero) or beyond it (where smoothing
// moves outwards): what is nearest within it.
constexpr f64 into_exact_range(f64 x) {
  const f64 within = max_of(-largest_magnitude, min_of(largest_magnitude, x));
  return abs_of(within) < smallest_magnitude ? 0.0 : within;
}

// Largest integer <= x, held within +-2^62. The bounds keep the conversion defined for any finite x.
constexpr i64 floor_to_integer(f64 x) {
  constexpr f64 bound = 0x1p62;
  if (!(x > -bound)) return -(i64{1} << 62);
  if (!(x < bound)) return i64{1} << 62;
  const i64 t = static_cast<i64>(x);
  return static_cast<f64>(t) > x ? t - 1 : t;
}

}  // namespace tpa
