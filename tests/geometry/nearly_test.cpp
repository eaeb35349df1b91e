// SPDX-License-Identifier: MIT
// Numbers of twice the precision of a double, against fractions of integers of any size: each lies within its bound,
// and the bound is small. A failure prints the seed and the number of the case.
#include "geometry/nearly.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "oracle/lattice_points.h"
#include "oracle/rational.h"
#include "support/share.h"

namespace nearly_test {
namespace {

using namespace big_int;
using lattice_points::Random;
using lattice_points::seed;
using support::Least;
using support::Share;
using tpa::Nearly;

struct KnownNumber {
  Nearly near;
  Rational value;
};

// A difference of coordinates: small whole numbers with many ties, anywhere, or of mixed magnitudes.
KnownNumber any_difference(Random& random, int kind) {
  const auto coordinate = [&] {
    if (kind == 0) return static_cast<double>(random.within(2));
    return std::ldexp(random.unit() - 0.5, kind == 1 ? 0 : static_cast<int>(random.within(60)));
  };
  const double a = coordinate(), b = coordinate();
  return {tpa::nearly_difference(a, b), Rational(a) - Rational(b)};
}

KnownNumber operator+(const KnownNumber& a, const KnownNumber& b) { return {a.near + b.near, a.value + b.value}; }
KnownNumber operator-(const KnownNumber& a, const KnownNumber& b) { return {a.near - b.near, a.value - b.value}; }
KnownNumber operator*(const KnownNumber& a, const KnownNumber& b) { return {a.near * b.near, a.value * b.value}; }

// Of any magnitude; Rational(double) takes coordinates.
Rational fraction_of(double x) {
  int exponent = 0;
  Rational out(std::ldexp(std::frexp(x, &exponent), 53));
  for (int left = exponent - 53; left != 0;) {
    const int part = std::clamp(left, -100, 100);
    out = out * Rational(std::ldexp(1.0, part));
    left -= part;
  }
  return out;
}

Rational size_of(const Rational& x) { return x.sign() < 0 ? Rational(BigInt(0)) - x : x; }

void expect_within(const KnownNumber& a) {
  const Rational error = size_of(a.value - fraction_of(a.near.high) - fraction_of(a.near.low));
  EXPECT_LE(compare(error, Rational(1.0001) * fraction_of(a.near.doubt)), 0);
  EXPECT_LE(std::abs(a.near.low), 0x1p-53 * std::abs(a.near.high));
}

TEST(NearNumbers, LieWithinTheirBounds) {
  Random random;
  int signs = 0, zeros = 0, roundings = 0, quotients = 0;
  for (int i = 0; i < Share(6000); ++i) {
    const int kind = i % 3;
    const auto any = [&] { return any_difference(random, kind); };
    const KnownNumber p = any() * any(), sum = p - any() * any(), cubic = sum * any() + any() * any() * any();
    // Zero, but for roundings.
    const KnownNumber x = any(), y = any(), z = any(), zero = (x - y) * z - (x * z - y * z);
    ASSERT_EQ(zero.value.sign(), 0);
    EXPECT_FALSE(is_rounded(zero.near + tpa::nearly(1)));
    for (const KnownNumber& a : {p, sum, cubic, zero}) {
      expect_within(a);
      const int sign = nearly_sign(a.near);
      EXPECT_TRUE(sign == 2 || sign == a.value.sign());
      signs += sign != 2;
      zeros += sign == 0;
    }
    if (const Nearly quotient = cubic.near / sum.near; quotient.doubt < 0x1p900) {
      ASSERT_NE(sum.value.sign(), 0);
      const KnownNumber shifted = KnownNumber{quotient, cubic.value / sum.value} + any();
      expect_within(shifted);
      ++quotients;
      if (is_rounded(shifted.near)) {
        const double at = shifted.near.high;
        const Rational gap = size_of(shifted.value - fraction_of(at));
        EXPECT_GT(gap.sign(), 0);
        for (const double beside : {std::nextafter(at, -INFINITY), std::nextafter(at, INFINITY)})
          EXPECT_LE(compare(gap, size_of(shifted.value - fraction_of(beside))), 0);
        ++roundings;
      }
    }
    ASSERT_FALSE(HasFailure()) << "seed " << seed << " case " << i;
  }
  EXPECT_GT(signs, Least(14000));
  EXPECT_GT(zeros, Least(300));
  EXPECT_GT(quotients, Least(4000));
  EXPECT_GT(roundings, Least(3000));
}

}  // namespace
}  // namespace nearly_test
