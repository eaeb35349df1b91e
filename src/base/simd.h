// SPDX-License-Identifier: MIT
// simd: vectors of four single-precision numbers (F4), of two doubles (D2), and their masks (I4, I2). All operations
// are IEEE operations lane by lane, in the order as written, so the bits are the bits of a plain loop on every platform
// (P6).
#pragma once

#include <string.h>

#include "base/fp.h"

// Processors with vector registers. TPA_PLAIN_LANES selects the plain loops, for tests.
#if (defined(__SSE2__) || defined(__ARM_NEON) || defined(__wasm_simd128__)) && !defined(TPA_PLAIN_LANES)
#define TPA_VECTORS
#if defined(__SSE2__)
#include <emmintrin.h>
#define TPA_SSE2
#endif
#endif

namespace tpa {

#if defined(TPA_VECTORS)
using F4 = f32 __attribute__((vector_size(16)));
using D2 = f64 __attribute__((vector_size(16)));
using I4 = i32 __attribute__((vector_size(16)));
using I2 = i64 __attribute__((vector_size(16)));

// Lane by lane: a if the mask is set, else b.
inline F4 chosen(I4 mask, F4 a, F4 b) { return mask ? a : b; }
inline D2 chosen(I2 mask, D2 a, D2 b) { return mask ? a : b; }
// The lanes with the given numbers; the lanes of b are numbered after the lanes of a.
template <int... number, class V>
inline V shuffled(V a, V b) {
  return __builtin_shufflevector(a, b, number...);
}
#else
// Plain loops. Compiler vectors would do, but GCC 12 makes twice the code of them on processors without registers.
template <class T, u32 n>
struct Lanes {
  T lane[n];

  template <size_t bytes, class Unused = void>
  struct Integer {
    using type = i32;
  };
  template <class Unused>
  struct Integer<8, Unused> {
    using type = i64;
  };
  using Mask = Lanes<typename Integer<sizeof(T)>::type, n>;

  constexpr T& operator[](u32 i) { return lane[i]; }
  constexpr T operator[](u32 i) const { return lane[i]; }

  template <class Of>
  static Lanes each(Of of) {
    Lanes all;
    for (u32 i = 0; i < n; ++i) all.lane[i] = static_cast<T>(of(i));
    return all;
  }
#define TPA_LANES(op)                                           \
  friend Lanes operator op(const Lanes& a, const Lanes& b) {    \
    return each([&](u32 i) { return a.lane[i] op b.lane[i]; }); \
  }                                                             \
  friend Lanes operator op(T a, const Lanes& b) {               \
    return each([&](u32 i) { return a op b.lane[i]; });         \
  }                                                             \
  friend Lanes operator op(const Lanes& a, T b) {               \
    return each([&](u32 i) { return a.lane[i] op b; });         \
  }                                                             \
  friend Lanes& operator op##=(Lanes& a, const Lanes& b) { return a = a op b; }
  TPA_LANES(+)
  TPA_LANES(-)
  TPA_LANES(*)
  TPA_LANES(/)
  TPA_LANES(&)
  TPA_LANES(|)
#undef TPA_LANES
#define TPA_LANES(op)                                                          \
  friend Mask operator op(const Lanes& a, const Lanes& b) {                    \
    return Mask::each([&](u32 i) { return a.lane[i] op b.lane[i] ? -1 : 0; }); \
  }
  TPA_LANES(<)
  TPA_LANES(<=)
  TPA_LANES(>)
  TPA_LANES(>=)
  TPA_LANES(==)
#undef TPA_LANES
  Lanes operator-() const {
    return each([&](u32 i) { return -lane[i]; });
  }
  Lanes operator~() const {
    return each([&](u32 i) { return ~lane[i]; });
  }
};
using F4 = Lanes<f32, 4>;
using D2 = Lanes<f64, 2>;
using I4 = Lanes<i32, 4>;
using I2 = Lanes<i64, 2>;

template <class T, u32 n>
inline Lanes<T, n> chosen(const typename Lanes<T, n>::Mask& mask, const Lanes<T, n>& a, const Lanes<T, n>& b) {
  return Lanes<T, n>::each([&](u32 i) { return mask[i] != 0 ? a[i] : b[i]; });
}
template <u32... number, class T, u32 n>
inline Lanes<T, n> shuffled(const Lanes<T, n>& a, const Lanes<T, n>& b) {
  return {(number < n ? a : b)[number % n]...};
}
#endif

inline F4 load4(const f32* p) {
  F4 v;
  memcpy(&v, p, sizeof v);
  return v;
}
inline void store4(f32* p, const F4& v) { memcpy(p, &v, sizeof v); }
inline D2 load2(const f64* p) {
  D2 v;
  memcpy(&v, p, sizeof v);
  return v;
}
inline void store2(f64* p, const D2& v) { memcpy(p, &v, sizeof v); }
inline D2 all2(f64 x) { return D2{x, x}; }
// Lane by lane; for equal numbers, and for a NaN, the second. Intrinsics, since compilers miss the instruction.
#if defined(TPA_SSE2)
inline D2 min2(const D2& a, const D2& b) {
  return reinterpret_cast<D2>(_mm_min_pd(reinterpret_cast<__m128d>(a), reinterpret_cast<__m128d>(b)));
}
inline D2 max2(const D2& a, const D2& b) {
  return reinterpret_cast<D2>(_mm_max_pd(reinterpret_cast<__m128d>(a), reinterpret_cast<__m128d>(b)));
}
inline F4 min4(const F4& a, const F4& b) {
  return reinterpret_cast<F4>(_mm_min_ps(reinterpret_cast<__m128>(a), reinterpret_cast<__m128>(b)));
}
inline F4 max4(const F4& a, const F4& b) {
  return reinterpret_cast<F4>(_mm_max_ps(reinterpret_cast<__m128>(a), reinterpret_cast<__m128>(b)));
}
#else
inline D2 min2(const D2& a, const D2& b) { return chosen(a < b, a, b); }
inline D2 max2(const D2& a, const D2& b) { return chosen(a > b, a, b); }
inline F4 min4(const F4& a, const F4& b) { return chosen(a < b, a, b); }
inline F4 max4(const F4& a, const F4& b) { return chosen(a > b, a, b); }
#endif
inline D2 abs_of(const D2& a) {
#if defined(TPA_VECTORS)
  constexpr i64 magnitude_bits = 0x7FFFFFFFFFFFFFFF;
  return reinterpret_cast<D2>(reinterpret_cast<I2>(a) & magnitude_bits);
#else
  return D2{abs_of(a[0]), abs_of(a[1])};
#endif
}
inline F4 all4(f32 x) { return F4{x, x, x, x}; }
inline F4 abs_of(const F4& a) {
#if defined(TPA_VECTORS)
  constexpr i32 magnitude_bits = 0x7FFFFFFF;
  return reinterpret_cast<F4>(reinterpret_cast<I4>(a) & magnitude_bits);
#else
  return F4{abs_of(a[0]), abs_of(a[1]), abs_of(a[2]), abs_of(a[3])};
#endif
}
inline F4 square_root(const F4& a) {
#if defined(TPA_SSE2)
  return reinterpret_cast<F4>(_mm_sqrt_ps(reinterpret_cast<__m128>(a)));
#else
  return F4{square_root(a[0]), square_root(a[1]), square_root(a[2]), square_root(a[3])};
#endif
}

#if defined(TPA_VECTORS)
// Rounded to single precision: the lanes of a, then the lanes of b.
inline F4 nearest4(const D2& a, const D2& b) {
#if defined(TPA_SSE2)
  const auto nearest = [](const D2& of) { return _mm_cvtpd_ps(reinterpret_cast<__m128d>(of)); };
  return reinterpret_cast<F4>(_mm_movelh_ps(nearest(a), nearest(b)));
#else
  return F4{static_cast<f32>(a[0]), static_cast<f32>(a[1]), static_cast<f32>(b[0]), static_cast<f32>(b[1])};
#endif
}
#endif
inline D2 square_root(const D2& a) {
#if defined(TPA_SSE2)
  return reinterpret_cast<D2>(_mm_sqrt_pd(reinterpret_cast<__m128d>(a)));
#else
  return D2{square_root(a[0]), square_root(a[1])};
#endif
}

// Bit i: lane i of the mask is set.
inline u32 bits_of(const I4& mask) {
#if defined(TPA_SSE2)
  return static_cast<u32>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  const I4 bits = mask & I4{1, 2, 4, 8};
  return static_cast<u32>(bits[0] | bits[1] | bits[2] | bits[3]);
#endif
}
// No overload of bits_of: masks of doubles convert to I4 as readily as to I2 in Clang.
inline u32 bits_of_two(const I2& mask) {
#if defined(TPA_SSE2)
  return static_cast<u32>(_mm_movemask_pd(reinterpret_cast<__m128d>(mask)));
#else
  const I2 bits = mask & I2{1, 2};
  return static_cast<u32>(bits[0] | bits[1]);
#endif
}
// The same for lanes 0 .. n - 1 only. Pre: n < 2^31.
inline u32 first_bits_of(const I4& mask, u32 n) {
#if defined(TPA_SSE2)
  const i32 k = static_cast<i32>(n);
  return bits_of(mask & (I4{0, 1, 2, 3} < I4{k, k, k, k}));
#else
  return bits_of(mask) & ((1u << min_of(n, 4u)) - 1);
#endif
}
inline f32 least_of(const F4& v) { return min_of(min_of(v[0], v[1]), min_of(v[2], v[3])); }
inline f32 largest_of(const F4& v) { return max_of(max_of(v[0], v[1]), max_of(v[2], v[3])); }

// Rows become columns.
inline void transpose(F4& a, F4& b, F4& c, F4& d) {
  const F4 ab_low = shuffled<0, 4, 1, 5>(a, b), ab_high = shuffled<2, 6, 3, 7>(a, b);
  const F4 cd_low = shuffled<0, 4, 1, 5>(c, d), cd_high = shuffled<2, 6, 3, 7>(c, d);
  a = shuffled<0, 1, 4, 5>(ab_low, cd_low);
  b = shuffled<2, 3, 6, 7>(ab_low, cd_low);
  c = shuffled<0, 1, 4, 5>(ab_high, cd_high);
  d = shuffled<2, 3, 6, 7>(ab_high, cd_high);
}

}  // namespace tpa
