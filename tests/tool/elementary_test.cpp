// SPDX-License-Identifier: MIT
// The elementary functions of the scenes: near those of the C library, and the same bits on every machine.
#include "tool/scenes/elementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "tool/scenes/points.h"

namespace elementary_test {
namespace {

constexpr double ulp = 0x1p-52;

TEST(Elementary, AreNearThoseOfTheCLibrary) {
  tool::Dice dice(1);
  for (int i = 0; i < 200000; ++i) {
    const double reach = std::ldexp(1, static_cast<int>(dice.below(21))), a = dice.uniform(-reach, reach);
    EXPECT_NEAR(tool::sine(a), std::sin(a), 4 * ulp) << a;
    EXPECT_NEAR(tool::cosine(a), std::cos(a), 4 * ulp) << a;
    const double x = dice.uniform(-1, 1), y = dice.uniform(-1, 1);
    EXPECT_NEAR(tool::arc_cosine(x), std::acos(x), 16 * ulp) << x;
    EXPECT_NEAR(tool::arc_tangent(y, x), std::atan2(y, x), 16 * ulp) << y << " " << x;
    const double t = dice.uniform(-1.5, 1.5);
    EXPECT_NEAR(tool::tangent(t) / std::tan(t), 1, 16 * ulp / std::cos(t)) << t;
    const double e = dice.uniform(-700, 700), p = std::exp(e);
    EXPECT_NEAR(tool::exponential(e) / p, 1, 4 * ulp) << e;
    EXPECT_NEAR(tool::logarithm(p), std::log(p), 4 * ulp * std::fmax(1, std::fabs(e))) << p;
    EXPECT_NEAR(tool::cube_root(p) / std::cbrt(p), 1, 0x1p-46) << p;
  }
}

TEST(Elementary, KnowTheAxes) {
  EXPECT_EQ(tool::sine(0), 0);
  EXPECT_EQ(tool::cosine(0), 1);
  EXPECT_EQ(tool::exponential(0), 1);
  EXPECT_EQ(tool::logarithm(1), 0);
  EXPECT_EQ(tool::arc_tangent(0, 0), 0);
  EXPECT_EQ(tool::arc_tangent(0, -1), tool::pi);
  EXPECT_EQ(tool::arc_tangent(-1, 0), -tool::pi / 2);
  EXPECT_EQ(tool::arc_cosine(1), 0);
  EXPECT_EQ(tool::arc_cosine(-1), tool::pi);
}

// The fingerprint (FNV-1a) of all bits, as computed in IEEE double precision without contraction, whatever the compiler
// and the processor.
TEST(Elementary, HaveTheSameBitsEverywhere) {
  tool::Dice dice(2);
  uint64_t fingerprint = 0xcbf29ce484222325;
  const auto take = [&](double value) {
    uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    for (int i = 0; i < 64; i += 8) fingerprint = (fingerprint ^ (bits >> i & 255)) * 0x100000001b3;
  };
  for (int i = 0; i < 100000; ++i) {
    const double a = dice.uniform(-100, 100), b = dice.uniform(-1, 1);
    for (const double value :
         {tool::sine(a), tool::cosine(a), tool::tangent(b), tool::arc_tangent(b, a), tool::arc_cosine(b),
          tool::exponential(a), tool::logarithm(a * a), tool::cube_root(a * a)})
      take(value);
  }
  EXPECT_EQ(fingerprint, 11377324494287511296u);
}

}  // namespace
}  // namespace elementary_test
