// SPDX-License-Identifier: MIT
// nearly: double-double numbers (Dekker 1971), each with a running bound on its error (Wilkinson 1963). They answer
// most questions about constructed points, and tell which need exact arithmetic (geometry/dyadic.h).
#pragma once

#include "geometry/expansion.h"

namespace tpa {

// A number within `doubt` of high + low, where |low| <= 2^-53 |high|. Without doubt, the number is that sum. Bounds
// have a few roundings of their own: nearly_sign() takes twice the bound, is_rounded() four times.
struct Nearly {
  f64 high, low, doubt;
};

constexpr Nearly nearly(f64 x) { return {x, 0, 0}; }
constexpr bool is_exact_zero(const Nearly& a) { return a.high == 0 && a.doubt == 0; }
constexpr Nearly nearly_difference(f64 a, f64 b) {
  const ExactPair s = two_sum(a, -b);
  return {s.high, s.low, 0};
}
constexpr Nearly operator-(const Nearly& a) { return {-a.high, -a.low, a.doubt}; }

constexpr Nearly operator+(const Nearly& a, const Nearly& b) {
  const ExactPair s = two_sum(a.high, b.high);
  const f64 lows = a.low + b.low, low = s.low + lows;
  const ExactPair sum = two_sum(s.high, low);
  return {sum.high, sum.low, a.doubt + b.doubt + 0x1p-52 * (abs_of(lows) + abs_of(low))};
}
constexpr Nearly operator-(const Nearly& a, const Nearly& b) { return a + -b; }

// The product of the lows is left out, 2^-106 of the result p; four roundings below 2^-52 |p|
// make 2^-103 |p| with it at most. 2^-960 is above what products lose to underflow. Exact zeros stay exact.
constexpr Nearly operator*(const Nearly& a, const Nearly& b) {
  const ExactPair p = two_product(a.high, b.high);
  const ExactPair product = two_sum(p.high, p.low + (a.high * b.low + a.low * b.high));
  const f64 given = abs_of(a.high) * b.doubt + (abs_of(b.high) + b.doubt) * a.doubt;
  const f64 own = is_exact_zero(a) || is_exact_zero(b) ? 0 : 0x1p-102 * abs_of(p.high) + 0x1p-960;
  return {product.high, product.low, given + own};
}

// With a rest r, a / b = q + r / b. The doubt is unlimited where b may be near zero.
constexpr Nearly operator/(const Nearly& a, const Nearly& b) {
  const f64 size = abs_of(b.high);
  if (!(0x1p20 * b.doubt < size)) return {0, 0, DBL_MAX};
  const f64 q = a.high / b.high;
  const Nearly rest = a - nearly(q) * b;
  const ExactPair quotient = two_sum(q, rest.high / b.high);
  const f64 doubt = abs_of(rest.low) + rest.doubt + abs_of(rest.high) * (0x1p-51 + b.doubt / size);
  const f64 underflow = is_exact_zero(a) ? 0 : 0x1p-960;
  return {quotient.high, quotient.low, 1.001 * doubt / size + underflow};
}

// Is a.high the number?
constexpr bool is_exact_double(const Nearly& a) { return a.low == 0 && a.doubt == 0; }

// The sign, or 2 where it is in doubt.
constexpr int nearly_sign(const Nearly& a) {
  const f64 doubt = 2 * a.doubt;
  return is_exact_zero(a) ? 0 : a.high > doubt ? 1 : a.high < -doubt ? -1 : 2;
}

// Is a.high the nearest double, and not the number itself, for certain? Pre: a is a sum: so four times the doubt is
// more than the rounding of the sums here.
constexpr bool is_rounded(const Nearly& a) {
  const f64 doubt = 4 * a.doubt;
  return abs_of(a.low) > doubt && a.high + (a.low + doubt) == a.high && a.high + (a.low - doubt) == a.high;
}

}  // namespace tpa
