// SPDX-License-Identifier: MIT
// expansion: exact sums and products of doubles, for the last stage of predicates (paper section 3).
// An expansion is a sum of doubles of growing magnitude with bits that do not overlap, so the last term has the sign of
// the whole (Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric predicates", 1997;
// theorem numbers below are Shewchuk's). Zero terms are dropped: zero itself has size 0.
// Coordinates are zero or of magnitude within [2^-100, 2^100], hence multiples of 2^-152. Products of up to three
// differences are multiples of 2^-456 below 2^304: nothing overflows or underflows, whatever the host does with
// subnormal numbers.
#pragma once

#include <string.h>

#include "base/vec3.h"

namespace tpa {

struct ExactPair {
  f64 high, low;  // high is the rounded result, high + low the exact one
};

// Knuth's sum, theorem 7. Any order of magnitudes.
constexpr ExactPair two_sum(f64 a, f64 b) {
  const f64 s = a + b;
  const f64 b_part = s - a;
  const f64 a_part = s - b_part;
  return {s, (a - a_part) + (b - b_part)};
}

// Dekker's sum, theorem 6. Needs |a| >= |b| or a == 0.
constexpr ExactPair fast_two_sum(f64 a, f64 b) {
  const f64 s = a + b;
  return {s, b - (s - a)};
}

// Dekker's split into two halves of 26 bits, theorem 17.
constexpr ExactPair split(f64 a) {
  constexpr f64 splitter = 0x1p27 + 1;
  const f64 c = splitter * a;
  const f64 high = c - (c - a);
  return {high, a - high};
}

// Veltkamp and Dekker, theorem 18. No fused multiply-add: hardware without the instruction would need libm.
constexpr ExactPair two_product(f64 a, f64 b, const ExactPair& b_half) {
  const f64 p = a * b;
  const ExactPair a_half = split(a);
  const f64 e1 = p - a_half.high * b_half.high;
  const f64 e2 = e1 - a_half.low * b_half.high;
  const f64 e3 = e2 - a_half.high * b_half.low;
  return {p, a_half.low * b_half.low - e3};
}
constexpr ExactPair two_product(f64 a, f64 b) { return two_product(a, b, split(b)); }

// h = e + f_sign * f (theorem 13, zero terms dropped). h has room for e_size + f_size terms and overlaps neither e nor
// f.
inline u32 add_terms(const f64* e, u32 e_size, const f64* f, u32 f_size, f64 f_sign, f64* h) {
  const u32 count = e_size + f_size;
  u32 i = 0, j = 0, size = 0;
  f64 q = 0;
  for (u32 k = 0; k < count; ++k) {
    const bool from_e = j == f_size || (i < e_size && abs_of(e[i]) < abs_of(f[j]));
    const f64 next = from_e ? e[i++] : f_sign * f[j++];
    const ExactPair s = two_sum(q, next);
    if (s.low != 0) h[size++] = s.low;
    q = s.high;
  }
  if (q != 0) h[size++] = q;
  return size;
}

// h = b * e (theorem 19, zero terms dropped). h has room for 2 * e_size terms and does not overlap e.
inline u32 scale_terms(const f64* e, u32 e_size, f64 b, f64* h) {
  const ExactPair b_half = split(b);
  u32 size = 0;
  f64 q = 0;
  for (u32 i = 0; i < e_size; ++i) {
    const ExactPair p = two_product(e[i], b, b_half);
    const ExactPair low = two_sum(q, p.low);
    const ExactPair high = fast_two_sum(p.high, low.high);
    if (low.low != 0) h[size++] = low.low;
    if (high.low != 0) h[size++] = high.low;
    q = high.high;
  }
  if (q != 0) h[size++] = q;
  return size;
}

template <u32 N>
struct Expansion {
  f64 term[N];
  u32 size;
};

template <u32 N>
constexpr int sign_of(const Expansion<N>& e) {
  return e.size == 0 ? 0 : e.term[e.size - 1] > 0 ? 1 : -1;
}

// a - b of two doubles.
inline Expansion<2> exact_difference(f64 a, f64 b) {
  const ExactPair s = two_sum(a, -b);
  Expansion<2> h;
  h.size = 0;
  if (s.low != 0) h.term[h.size++] = s.low;
  if (s.high != 0) h.term[h.size++] = s.high;
  return h;
}

template <u32 N, u32 M>
Expansion<N + M> operator-(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<N + M> h;
  h.size = add_terms(e.term, e.size, f.term, f.size, -1, h.term);
  return h;
}

template <u32 N>
Expansion<2 * N> operator*(const Expansion<N>& e, f64 b) {
  Expansion<2 * N> h;
  h.size = b == 0 ? 0 : scale_terms(e.term, e.size, b, h.term);
  return h;
}

// The products of e with the terms of f, added one by one. Scratch on the stack: 16 N (M + 1) bytes.
template <u32 N, u32 M>
Expansion<2 * N * M> operator*(const Expansion<N>& e, const Expansion<M>& f) {
  Expansion<2 * N * M> h;
  h.size = f.size == 0 ? 0 : scale_terms(e.term, e.size, f.term[0], h.term);
  for (u32 j = 1; j < f.size; ++j) {
    const Expansion<2 * N> part = e * f.term[j];
    f64 before[2 * N * M];
    memcpy(before, h.term, h.size * sizeof(f64));
    h.size = add_terms(before, h.size, part.term, part.size, 1, h.term);
  }
  return h;
}

struct ExactVec3 {
  Expansion<2> x, y, z;
};
// a - b of two points.
inline ExactVec3 exact_vector(const Vec3& a, const Vec3& b) {
  return {exact_difference(a.x, b.x), exact_difference(a.y, b.y), exact_difference(a.z, b.z)};
}

// a d - b c.
using Minor = Expansion<16>;
inline Minor minor_of(const Expansion<2>& a, const Expansion<2>& b, const Expansion<2>& c, const Expansion<2>& d) {
  return a * d - b * c;
}

}  // namespace tpa
