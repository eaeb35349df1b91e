// SPDX-License-Identifier: MIT
// fp: IEEE operations with the same bits everywhere (P6), and the range of numbers that exact arithmetic admits. The
// predicates and every tie-break rest on these bits, so compiler modes that break them are refused.
#pragma once

#include <float.h>

#include "base/base.h"

// Roots that never set errno, so that a linker needs no sqrt() of the C library: by the flag -fno-math-errno; without
// it by a builtin of newer Clangs, or by the processor's vector instructions.
#if !defined(__NO_MATH_ERRNO__) && defined(__has_builtin)
#if __has_builtin(__builtin_elementwise_sqrt)
#define TPA_ROOT_BUILTIN
#endif
#endif
#if !defined(__NO_MATH_ERRNO__) && !defined(TPA_ROOT_BUILTIN)
#if defined(__SSE2__)
#define TPA_ROOT_SSE2
#include <emmintrin.h>
#elif defined(__aarch64__)
#define TPA_ROOT_NEON
#include <arm_neon.h>
#endif
#endif

#if defined(__FAST_MATH__) || (defined(_MSC_VER) && defined(_M_FP_FAST))
#error "topoadapt needs IEEE arithmetic: compile without -ffast-math (MSVC: without /fp:fast)"
#endif
#if defined(FLT_EVAL_METHOD) && FLT_EVAL_METHOD != 0
#error "topoadapt needs double operations in double precision: compile for 32-bit x86 with -msse2 -mfpmath=sse"
#endif

namespace tpa {

static_assert(sizeof(f64) == 8 && DBL_MANT_DIG == 53 && DBL_MAX_EXP == 1024, "IEEE 754 binary64");

// Between these magnitudes, products of four differences neither overflow nor lose a bit to underflow, even when the
// host flushes subnormal numbers to zero. Zero itself is allowed.
inline constexpr f64 smallest_magnitude = 0x1p-100;
inline constexpr f64 largest_magnitude = 0x1p100;

// Builtins: plain instructions on most processors, without calls of the C library.
constexpr f64 abs_of(f64 x) { return __builtin_fabs(x); }
constexpr f32 abs_of(f32 x) { return __builtin_fabsf(x); }
inline f64 square_root(f64 x) {
#if defined(TPA_ROOT_BUILTIN)
  return __builtin_elementwise_sqrt(x);
#elif defined(TPA_ROOT_SSE2)
  return _mm_cvtsd_f64(_mm_sqrt_sd(_mm_setzero_pd(), _mm_set_sd(x)));
#elif defined(TPA_ROOT_NEON)
  return vget_lane_f64(vsqrt_f64(vdup_n_f64(x)), 0);
#else
  return __builtin_sqrt(x);
#endif
}
// Rounded once or twice with the same bits (Figueroa 1995): processors without the instruction need sqrt() alone, not
// sqrtf() besides.
inline f32 square_root(f32 x) {
#if defined(TPA_ROOT_SSE2)
  return _mm_cvtss_f32(_mm_sqrt_ss(_mm_set_ss(x)));
#elif defined(__SSE2__) && !defined(TPA_ROOT_BUILTIN)
  return __builtin_sqrtf(x);
#else
  return static_cast<f32>(square_root(static_cast<f64>(x)));
#endif
}

// -1, 0 or 1: the sign of a - b.
constexpr int compare(f64 a, f64 b) { return (a > b) - (a < b); }

// Is x zero or within the range of exact arithmetic? False for NaN and infinities.
constexpr bool in_exact_range(f64 x) {
  const f64 m = abs_of(x);
  return x == 0 || (m >= smallest_magnitude && m <= largest_magnitude);
}

// The nearest number in the range, for results of the library's own: a mean of numbers near zero may fall below the
// range, and smoothing may move a vertex beyond it.
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
