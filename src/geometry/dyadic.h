// SPDX-License-Identifier: MIT
// dyadic: exact numbers for predicates on constructed points (Attene 2020, indirect predicates). A dyadic number is an
// integer times a power of 2^32. Doubles are dyadic, and so are their sums and products. Expansions of doubles would
// overflow beyond degree ten (base/fp.h); dyadic numbers have no such limit.
//
// Sizes follow from degrees: a polynomial of degree D in coordinates, zero or within [2^-100, 2^100], has at most 9 D
// limbs. Short numbers, as in meshes on a grid, stay short: limbs of zero at both ends are dropped.
#pragma once

#include "base/fp.h"

namespace tpa {

inline constexpr u32 limbs_of_degree = 9;  // 2^-152 .. 2^101 in limbs of 32 bits

template <u32 Degree>
struct Dyadic {
  static constexpr u32 most_limbs = limbs_of_degree * Degree;
  i32 sign;  // -1, 0, 1
  i32 low;   // exponent of the lowest limb, in limbs
  u32 size;  // limbs in use; neither the first nor the last is zero
  u32 limb[most_limbs];
};

namespace dyadic_detail {
// The same numbers with any room for limbs.
struct DyadicView {
  i32 sign, low;
  u32 size;
  const u32* limb;
};
struct DyadicTarget {
  i32 &sign, &low;
  u32& size;
  u32* limb;
};
template <u32 D>
DyadicView view(const Dyadic<D>& a) {
  return {a.sign, a.low, a.size, a.limb};
}
template <u32 D>
DyadicTarget target(Dyadic<D>& a) {
  return {a.sign, a.low, a.size, a.limb};
}
void read(f64 value, DyadicTarget out);
void multiply(const DyadicView& a, const DyadicView& b, DyadicTarget out);
// a + sign * b.
void add(const DyadicView& a, const DyadicView& b, i32 sign, DyadicTarget out);
f64 quotient(const DyadicView& a, const DyadicView& b, u32* room, u32 words, bool& exact);
}  // namespace dyadic_detail

// Pre: zero or of magnitude within [2^-100, 2^100].
inline Dyadic<1> dyadic(f64 value) {
  Dyadic<1> out;
  dyadic_detail::read(value, dyadic_detail::target(out));
  return out;
}

template <u32 A, u32 B>
Dyadic<A + B> operator*(const Dyadic<A>& a, const Dyadic<B>& b) {
  Dyadic<A + B> out;
  dyadic_detail::multiply(dyadic_detail::view(a), dyadic_detail::view(b), dyadic_detail::target(out));
  return out;
}
template <u32 D>
Dyadic<D> operator+(const Dyadic<D>& a, const Dyadic<D>& b) {
  Dyadic<D> out;
  dyadic_detail::add(dyadic_detail::view(a), dyadic_detail::view(b), 1, dyadic_detail::target(out));
  return out;
}
template <u32 D>
Dyadic<D> operator-(const Dyadic<D>& a, const Dyadic<D>& b) {
  Dyadic<D> out;
  dyadic_detail::add(dyadic_detail::view(a), dyadic_detail::view(b), -1, dyadic_detail::target(out));
  return out;
}
template <u32 D>
constexpr int sign_of(const Dyadic<D>& a) {
  return a.sign;
}

// a / b rounded to nearest, ties to even; 0 below the range of coordinates. So equal quotients give equal doubles, and
// rounding keeps the order. Pre: b is not zero, and the quotient is below 2^101. `exact`: the quotient is that double.
template <u32 A, u32 B>
f64 rounded_quotient(const Dyadic<A>& a, const Dyadic<B>& b, bool& exact) {
  constexpr u32 words = limbs_of_degree * (A > B ? A : B) + 2;
  u32 room[2 * words];
  return dyadic_detail::quotient(dyadic_detail::view(a), dyadic_detail::view(b), room, words, exact);
}

}  // namespace tpa
