// SPDX-License-Identifier: MIT
// Lanes against single numbers, bit for bit. Compiled twice: with the processor's vector registers, and with plain
// loops (TPA_PLAIN_LANES).
#include "base/simd.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <type_traits>

#include "gtest/gtest.h"

namespace simd_test {
namespace {

using tpa::D2;
using tpa::F4;
using tpa::I4;

template <class T>
auto Bits(T x) {
  std::conditional_t<sizeof(T) == 8, uint64_t, uint32_t> bits;
  std::memcpy(&bits, &x, sizeof bits);
  return bits;
}
// All NaNs are the same: processors differ in the NaN of a sum.
template <class T>
bool Same(T a, T b) {
  return Bits(a) == Bits(b) || (std::isnan(a) && std::isnan(b));
}

class Dice {
 public:
  // Mostly ordinary numbers; the rest are critical for comparisons and signs.
  template <class T>
  T Number() {
    constexpr T rare[] = {T(0),
                          -T(0),
                          T(1),
                          -T(1),
                          std::numeric_limits<T>::infinity(),
                          -std::numeric_limits<T>::infinity(),
                          std::numeric_limits<T>::quiet_NaN(),
                          std::numeric_limits<T>::denorm_min(),
                          std::numeric_limits<T>::max()};
    if (random_() % 3 == 0) return rare[random_() % std::size(rare)];
    const double digits = 1.0 + 0x1p-20 * static_cast<double>(random_() % (1 << 20));
    return static_cast<T>(std::ldexp(digits, static_cast<int>(random_() % 9) - 4)) *
           (random_() % 2 == 0 ? T(1) : -T(1));
  }
  F4 Four() { return F4{Number<float>(), Number<float>(), Number<float>(), Number<float>()}; }
  D2 Two() { return D2{Number<double>(), Number<double>()}; }
  int32_t Integer() { return static_cast<int32_t>(random_()); }

 private:
  std::mt19937 random_{1};
};

template <class V, class Of>
void ExpectLanes(const V& lanes, uint32_t n, const char* what, Of of) {
  for (uint32_t i = 0; i < n; ++i) EXPECT_TRUE(Same(lanes[i], of(i))) << what << " " << i;
}

// The operators of C++ on numbers.
template <class V, class T>
void ExpectArithmetic(const V& a, const V& b, T x, uint32_t n) {
  ExpectLanes(a + b, n, "a + b", [&](uint32_t i) { return a[i] + b[i]; });
  ExpectLanes(a - b, n, "a - b", [&](uint32_t i) { return a[i] - b[i]; });
  ExpectLanes(a * b, n, "a * b", [&](uint32_t i) { return a[i] * b[i]; });
  ExpectLanes(a / b, n, "a / b", [&](uint32_t i) { return a[i] / b[i]; });
  ExpectLanes(x - b, n, "x - b", [&](uint32_t i) { return x - b[i]; });
  ExpectLanes(a - x, n, "a - x", [&](uint32_t i) { return a[i] - x; });
  ExpectLanes(x * b, n, "x * b", [&](uint32_t i) { return x * b[i]; });
  ExpectLanes(-a, n, "-a", [&](uint32_t i) { return -a[i]; });
  V sum = a, product = a;
  sum += b, product *= b;
  ExpectLanes(sum, n, "+=", [&](uint32_t i) { return a[i] + b[i]; });
  ExpectLanes(product, n, "*=", [&](uint32_t i) { return a[i] * b[i]; });
}

TEST(Lanes, ComputeWhatOneNumberDoes) {
  Dice dice;
  for (int round = 0; round < 2000; ++round) {
    const F4 a = dice.Four(), b = dice.Four();
    const D2 c = dice.Two(), d = dice.Two();
    ExpectArithmetic(a, b, dice.Number<float>(), 4);
    ExpectArithmetic(c, d, dice.Number<double>(), 2);
    ExpectLanes(tpa::min4(a, b), 4, "min4", [&](uint32_t i) { return a[i] < b[i] ? a[i] : b[i]; });
    ExpectLanes(tpa::max4(a, b), 4, "max4", [&](uint32_t i) { return a[i] > b[i] ? a[i] : b[i]; });
    ExpectLanes(tpa::min2(c, d), 2, "min2", [&](uint32_t i) { return c[i] < d[i] ? c[i] : d[i]; });
    ExpectLanes(tpa::max2(c, d), 2, "max2", [&](uint32_t i) { return c[i] > d[i] ? c[i] : d[i]; });
    ExpectLanes(tpa::abs_of(a), 4, "abs_of", [&](uint32_t i) { return std::fabs(a[i]); });
    ExpectLanes(tpa::abs_of(c), 2, "abs_of", [&](uint32_t i) { return std::fabs(c[i]); });
    ExpectLanes(tpa::square_root(a), 4, "square_root", [&](uint32_t i) { return std::sqrt(a[i]); });
    ExpectLanes(tpa::square_root(c), 2, "square_root", [&](uint32_t i) { return std::sqrt(c[i]); });
#if defined(TPA_VECTORS)
    const auto rounded = [&](uint32_t i) { return static_cast<float>((i < 2 ? c : d)[i % 2]); };
    ExpectLanes(tpa::nearest4(c, d), 4, "nearest4", rounded);
#endif
  }
}

TEST(Lanes, CompareAsOneNumberDoes) {
  Dice dice;
  for (int round = 0; round < 2000; ++round) {
    const F4 a = dice.Four(), b = dice.Four();
    const D2 c = dice.Two(), d = dice.Two();
    const I4 ids{dice.Integer(), dice.Integer(), dice.Integer(), dice.Integer()};
    const I4 others{ids[0], dice.Integer(), ids[2], 7};
    const I4 less = a<b, more = a> b, at_most = a <= b, equal = ids == others;
    uint32_t bits = 0;
    for (uint32_t i = 0; i < 4; ++i) {
      EXPECT_EQ(less[i], a[i] < b[i] ? -1 : 0);
      EXPECT_EQ(more[i], a[i] > b[i] ? -1 : 0);
      EXPECT_EQ(at_most[i], a[i] <= b[i] ? -1 : 0);
      EXPECT_EQ(equal[i], ids[i] == others[i] ? -1 : 0);
      bits |= (a[i] < b[i] ? 1u : 0u) << i;
    }
    EXPECT_EQ(tpa::bits_of_two(c < d), (c[0] < d[0] ? 1u : 0u) | (c[1] < d[1] ? 2u : 0u));
    const auto differ = [&](uint32_t i) { return c[i] > d[i] || c[i] < d[i]; };
    EXPECT_EQ(tpa::bits_of_two((c > d) | (c < d)), (differ(0) ? 1u : 0u) | (differ(1) ? 2u : 0u));
    EXPECT_EQ(tpa::bits_of(less), bits);
    EXPECT_EQ(tpa::bits_of(~less), bits ^ 15);
    EXPECT_EQ(tpa::bits_of(less & more), 0u);
    EXPECT_EQ(tpa::bits_of(less | ~less), 15u);
    for (const uint32_t n : {0u, 1u, 2u, 3u, 4u, 5u, 64u, 1u << 30})
      EXPECT_EQ(tpa::first_bits_of(less, n), n < 4 ? bits & ((1u << n) - 1) : bits) << n;
    ExpectLanes(tpa::chosen(c < d, c, d), 2, "chosen", [&](uint32_t i) { return c[i] < d[i] ? c[i] : d[i]; });
    EXPECT_TRUE(Same(tpa::largest_of(F4{1, 4, 3, 2}), 4.0f) && Same(tpa::least_of(F4{3, 4, 1, 2}), 1.0f));
  }
}

TEST(Lanes, ChangePlacesAsTheyAreTold) {
  F4 row[4] = {F4{0, 1, 2, 3}, F4{4, 5, 6, 7}, F4{8, 9, 10, 11}, F4{12, 13, 14, 15}};
  const F4 turned{5, 6, 4, 5}, mixed{3, 4, 0, 7};
  ExpectLanes(tpa::shuffled<1, 2, 0, 1>(row[1], row[1]), 4, "turned", [&](uint32_t i) { return turned[i]; });
  ExpectLanes(tpa::shuffled<3, 4, 0, 7>(row[0], row[1]), 4, "mixed", [&](uint32_t i) { return mixed[i]; });
  ExpectLanes(tpa::shuffled<1, 2>(D2{1, 2}, D2{3, 4}), 2, "shuffled", [](uint32_t i) { return i + 2.0; });
  tpa::transpose(row[0], row[1], row[2], row[3]);
  for (uint32_t r = 0; r < 4; ++r) ExpectLanes(row[r], 4, "transpose", [&](uint32_t i) { return float(4 * i + r); });
  float kept[6] = {9, 9, 9, 9, 9, 9};
  tpa::store4(kept + 1, tpa::load4(&kept[1]) + F4{1, 2, 3, 4});
  EXPECT_EQ(kept[0], 9);
  EXPECT_EQ(kept[1], 10);
  EXPECT_EQ(kept[4], 13);
  EXPECT_EQ(kept[5], 9);
}

}  // namespace
}  // namespace simd_test
