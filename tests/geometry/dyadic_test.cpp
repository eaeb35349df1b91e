// SPDX-License-Identifier: MIT
// Dyadic numbers against integers of any size. 2^160 x is an integer for each coordinate x, and 160 bits are five limbs
// of both kinds of numbers.
#include "geometry/dyadic.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "oracle/lattice_points.h"
#include "oracle/rational.h"
#include "support/share.h"

namespace dyadic_test {
namespace {

using big_int::BigInt;
using lattice_points::Random;
using lattice_points::seed;
using support::Least;
using support::Share;
using tpa::Dyadic;
using tpa::dyadic;
using tpa::u32;

constexpr double smallest = 0x1p-100, largest = 0x1p100;

// a * 2^(160 D). Expects the shape that dyadic.h promises.
template <u32 D>
BigInt whole(const Dyadic<D>& a) {
  EXPECT_LE(a.size, Dyadic<D>::most_limbs);
  EXPECT_EQ(a.sign == 0, a.size == 0);
  EXPECT_GE(a.low + 5 * static_cast<int>(D), a.size == 0 ? -1000 : 0);
  BigInt out;
  if (a.size == 0) return out;
  EXPECT_NE(a.limb[0], 0u);
  EXPECT_NE(a.limb[a.size - 1], 0u);
  out.limb.assign(static_cast<size_t>(a.low) + 5 * D, 0);
  out.limb.insert(out.limb.end(), a.limb, a.limb + a.size);
  out.negative = a.sign < 0;
  return out;
}

template <u32 D>
void expect_equal(const Dyadic<D>& a, const BigInt& wanted) {
  EXPECT_EQ(compare(whole(a), wanted), 0);
  EXPECT_EQ(sign_of(a), wanted.sign());
}

BigInt scaled_or_zero(double x) { return x == 0 ? BigInt(0) : big_int::scaled(x); }

// Full and short mantissas of all magnitudes, zero, and the ends of the range.
double any_number(Random& random) {
  switch (random.upto(9)) {
    case 0: return static_cast<double>(random.within(4));
    case 1: return std::ldexp(static_cast<double>(random.within(1)), static_cast<int>(random.within(100)));
    case 2: return random.upto(1) != 0 ? largest : -smallest;
    case 3: return random.upto(1) != 0 ? std::nextafter(-largest, 0) : std::nextafter(smallest, 1);
    case 4: return random.unit() + smallest;
    default: return random.any_magnitude();
  }
}

TEST(Dyadic, HoldsEveryCoordinate) {
  Random random;
  std::vector<double> numbers{0.0, -0.0};
  for (int e = -100; e <= 100; ++e)
    for (const double m : {1.0, 1.5, std::nextafter(1.0, 0), std::nextafter(1.0, 2)})
      numbers.push_back(std::ldexp(m, e));
  for (int i = 0; i < Share(50000); ++i) numbers.push_back(random.any_magnitude());
  for (const double x : numbers) {
    if (!tpa::in_exact_range(x)) continue;
    expect_equal(dyadic(x), scaled_or_zero(x));
    expect_equal(dyadic(-x), scaled_or_zero(-x));
    ASSERT_FALSE(testing::Test::HasFailure()) << x << " seed " << seed;
  }
}

// A polynomial of degree D, made of numbers of lower degree, and its integer.
template <u32 D>
struct Known {
  Dyadic<D> number;
  BigInt integer;
};
Known<1> known(double x) { return {dyadic(x), scaled_or_zero(x)}; }
template <u32 A, u32 B>
Known<A + B> operator*(const Known<A>& a, const Known<B>& b) {
  return {a.number * b.number, a.integer * b.integer};
}
template <u32 D>
Known<D> operator+(const Known<D>& a, const Known<D>& b) {
  return {a.number + b.number, a.integer + b.integer};
}
template <u32 D>
Known<D> operator-(const Known<D>& a, const Known<D>& b) {
  return {a.number - b.number, a.integer - b.integer};
}
template <u32 D>
void expect_known(const Known<D>& a) {
  expect_equal(a.number, a.integer);
}

TEST(Dyadic, CalculatesWithoutAnError) {
  Random random;
  int zeros = 0;
  for (int i = 0; i < Share(10000); ++i) {
    Known<1> x[6];
    for (auto& k : x) k = known(any_number(random));
    const double near = random.any_magnitude() / 2 + 0x1p-99;
    const Known<1> a = known(near), b = known(std::nextafter(near, largest));
    const Known<1> close = i % 3 == 0 ? a - b : i % 3 == 1 ? x[0] - x[1] : x[0] - x[0];
    const Known<2> area = close * x[2] - x[3] * x[4], flat = (x[0] + x[1]) * x[5] - x[0] * x[5] - x[1] * x[5];
    const Known<3> volume = area * x[5] + (close + x[1]) * flat - x[2] * x[2] * x[2];
    const Known<6> square = volume * volume - (area * x[0] + area * x[1]) * volume;
    const Known<7> high = square * x[0] + square * close;
    const Known<20> highest = high * high * square - square * high * high + high * square * (high - square * x[4]);
    expect_known(close);
    expect_known(area);
    expect_known(flat);
    expect_known(volume);
    expect_known(square);
    expect_known(high);
    expect_known(highest);
    zeros += highest.number.sign == 0;
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << " case " << i;
  }
  EXPECT_GT(zeros, Least(100));
  EXPECT_LT(zeros, 8000);
}

// Sums of the longest numbers: all limbs in use, and carries from end to end.
TEST(Dyadic, HasRoomForTheLongestNumbers) {
  const Known<1> most = known(largest) + known(largest) - known(smallest), least = known(smallest) - known(largest);
  Known<2> two = most * most;
  const Known<4> four = two * two - two * (most * least);
  const Known<8> eight = four * four + four * four;
  const Known<16> sixteen = eight * eight + eight * eight;
  const Known<20> twenty = sixteen * four + sixteen * four;
  expect_known(four);
  expect_known(eight);
  expect_known(sixteen);
  expect_known(twenty);
  expect_known(twenty - twenty);
}

// ---------------------------------------------------------------- quotients

// |a| * 2^(160 times).
BigInt raised(BigInt a, u32 times) {
  a.negative = false;
  if (a.sign() != 0) a.limb.insert(a.limb.begin(), size_t{5} * times, 0);
  return a;
}

// The sign of |a / b| - (x + y) / 2.
template <u32 A, u32 B>
int beside_middle(const Known<A>& a, const Known<B>& b, double x, double y) {
  const BigInt sum = scaled_or_zero(x) + scaled_or_zero(y);
  return compare(raised(a.integer, B + 1) * 2, raised(b.integer, A) * sum);
}

bool is_even(double x) {
  uint64_t bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits % 2 == 0;
}

// Is q the quotient rounded to nearest, ties to even? Each number has an interval between two middles, with the middles
// if the number is even.
template <u32 A, u32 B>
void expect_rounded(const Known<A>& a, const Known<B>& b) {
  bool exact = false;
  const double q = rounded_quotient(a.number, b.number, exact), size = std::abs(q);
  if (a.integer.sign() == 0) {
    EXPECT_EQ(q, 0);
    EXPECT_TRUE(exact);
    return;
  }
  EXPECT_EQ(exact, size > 0 && beside_middle(a, b, size, size) == 0);
  if (size == 0) {
    EXPECT_LT(beside_middle(a, b, std::nextafter(smallest, 0), smallest), 0) << "lost";
    return;
  }
  EXPECT_EQ(q < 0 ? -1 : 1, a.integer.sign() * b.integer.sign());
  EXPECT_GE(size, smallest);
  const int low = beside_middle(a, b, std::nextafter(size, 0), size);
  EXPECT_TRUE(is_even(q) ? low >= 0 : low > 0) << "too large: " << q;
  if (size == largest) return;  // the nearest number in range
  const int high = beside_middle(a, b, size, std::nextafter(size, largest));
  EXPECT_TRUE(is_even(q) ? high <= 0 : high < 0) << "too small: " << q;
}

template <u32 A, u32 B>
double nearest_quotient(const Dyadic<A>& a, const Dyadic<B>& b) {
  bool exact = false;
  return rounded_quotient(a, b, exact);
}

template <u32 A, u32 B>
bool is_below_range_end(const Known<A>& a, const Known<B>& b) {
  return beside_middle(a, b, largest, largest) <= 0;
}

TEST(RoundedQuotient, IsTheNearestDouble) {
  Random random;
  int judged = 0;
  for (int i = 0; i < Share(10000); ++i) {
    Known<1> x[4];
    for (auto& k : x) k = known(any_number(random));
    const Known<2> area = x[0] * x[1] - x[2] * x[3];
    const Known<3> volume = area * x[0] + area * x[3];
    if (area.integer.sign() == 0 || !is_below_range_end(volume, area)) continue;
    expect_rounded(volume, area);
    const Known<6> w = volume * volume + area * area * area;
    const Known<7> point = w * x[0] - volume * area * area + w * x[2];
    if (w.integer.sign() != 0 && is_below_range_end(point, w)) expect_rounded(point, w);
    judged += w.integer.sign() != 0;
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << " case " << i;
  }
  EXPECT_GT(judged, Least(2000));
}

TEST(RoundedQuotient, AgreesWithTheProcessorOnIntegers) {
  Random random;
  for (int i = 0; i < Share(100000); ++i) {
    const long long n = i % 2 == 0 ? 60 : 1ll << 52;
    const auto a = static_cast<double>(random.within(n)), b = static_cast<double>(1 + random.upto(n));
    ASSERT_EQ(nearest_quotient(dyadic(a), dyadic(b)), a / b) << a << " / " << b << " seed " << seed;
    ASSERT_EQ(nearest_quotient(dyadic(a) * dyadic(b), dyadic(-b) * dyadic(b)), -a / b) << a << " / " << b;
  }
}

// Middles between neighbours, and numbers beside middles by as little as 2^-400.
TEST(RoundedQuotient, BreaksTiesToEven) {
  Random random;
  for (int i = 0; i < Share(4000); ++i) {
    double low =
        i % 10 == 0 ? std::ldexp(1.0, static_cast<int>(random.within(99))) : std::abs(random.any_magnitude()) / 2;
    if (i % 7 == 0) low = smallest * static_cast<double>(1 + random.upto(3));
    low = std::max(low, smallest);
    const double high = std::nextafter(low, largest), factor = random.any_magnitude(), tiny = smallest;
    const Known<4> by = known(factor) * known(random.unit() + tiny) * known(random.unit() + tiny) * known(factor);
    const Known<5> twice = by * known(2), sum = by * known(low) + by * known(high), zero = sum - sum;
    const Known<5> least = known(tiny) * known(tiny) * known(tiny) * known(tiny) * known(tiny);
    EXPECT_EQ(nearest_quotient(sum.number, twice.number), is_even(low) ? low : high);
    for (const Known<5>& a : {sum, sum + least, sum - least, zero - sum, by * known(low) + by * known(low)}) {
      expect_rounded(a, twice);
      expect_rounded(a, zero - twice);
    }
    ASSERT_FALSE(testing::Test::HasFailure()) << "seed " << seed << " case " << i << " low " << low;
  }
}

TEST(RoundedQuotient, IsZeroBelowTheRange) {
  const Known<2> one = known(1) * known(1), least = known(smallest) * known(1);
  const Known<2> below = known(std::nextafter(1.0, 0)) * known(smallest);  // 2^-100 (1 - 2^-53)
  EXPECT_EQ(nearest_quotient(least.number, one.number), smallest);
  EXPECT_EQ(nearest_quotient(below.number, one.number), 0);
  EXPECT_EQ(nearest_quotient(least.number + below.number, one.number + one.number), smallest);  // a tie
  const Known<4> middle = (least + below) * one, two = (one + one) * one, dust = least * least;
  EXPECT_EQ(nearest_quotient((middle - dust).number, two.number), 0);
  EXPECT_EQ(nearest_quotient((middle + dust).number, two.number), smallest);
  EXPECT_EQ(nearest_quotient(dust.number, one.number), 0);
  for (const Known<4>& a : {middle, middle - dust, middle + dust, dust}) expect_rounded(a, two);
}

}  // namespace
}  // namespace dyadic_test
