// SPDX-License-Identifier: MIT
// Compiled twice: as it is, and for a processor whose environment the library cannot set.
#include "base/float_environment.h"

#include <gtest/gtest.h>

#include "support/host_environment.h"

namespace float_environment_test {
namespace {

using namespace support;

#if !defined(TPA_UNKNOWN_FLOAT_STATE)

// At run time, whatever compilers know.
double Sum(double a, double b) {
  volatile double x = a, y = b;
  return x + y;
}
double Quotient(double a, double b) {
  volatile double x = a, y = b;
  return x / y;
}
float QuotientOfFloats(float a, float b) {
  volatile float x = a, y = b;
  return x / y;
}

TEST(FloatEnvironment, ArithmeticIsAsNeededInside) {
  for (const HostEnvironment& e : HostEnvironments()) {
    double up = 0, down = 0, nearest = 0, third = 0, subnormal = 0, infinity = 0, nan = 0;
    float subnormal_float = 0;
    bool unchanged = false;
    {
      const Hosted host(e);
      {
        const tpa::FloatEnvironment environment;
        up = Sum(1, 0x1p-60);
        down = Sum(-1, -0x1p-60);
        nearest = Sum(1, 0x1.8p-53);
        third = Quotient(1, 3);
        subnormal = Quotient(0x1p-1022, 4);
        subnormal_float = QuotientOfFloats(0x1p-126f, 4);
        infinity = Quotient(1, 0);
        nan = Quotient(0, 0);
        EXPECT_TRUE(tpa::rounds_as_needed()) << e.name;
      }
      unchanged = host.Unchanged();
    }
    EXPECT_TRUE(unchanged) << e.name;
    EXPECT_EQ(up, 1) << e.name;
    EXPECT_EQ(down, -1) << e.name;
    EXPECT_EQ(nearest, 1 + 0x1p-52) << e.name;
    EXPECT_EQ(third, 0x1.5555555555555p-2) << e.name;
    EXPECT_EQ(subnormal, 0x1p-1024) << e.name;
    EXPECT_EQ(subnormal_float, 0x1p-128f) << e.name;
    EXPECT_GT(infinity, 1e308) << e.name;
    EXPECT_NE(nan, nan) << e.name;
  }
}

// On 32-bit x86 they go through a unit of its own.
TEST(FloatEnvironment, ConversionsOf64BitIntegersAreRoundedToNearest) {
  for (const HostEnvironment& e : HostEnvironments()) {
    volatile int64_t below = -((int64_t{1} << 62) + 255);
    volatile uint64_t above = (uint64_t{1} << 63) + 1025;
    double of_signed = 0, of_unsigned = 0;
    bool unchanged = false;
    {
      const Hosted host(e);
      {
        const tpa::FloatEnvironment environment;
        of_signed = static_cast<double>(below);
        of_unsigned = static_cast<double>(above);
      }
      unchanged = host.Unchanged();
    }
    EXPECT_TRUE(unchanged) << e.name;
    EXPECT_EQ(of_signed, -0x1p62) << e.name;
    EXPECT_EQ(of_unsigned, 0x1p63 + 2048) << e.name;
  }
}

#else

TEST(UnknownFloatEnvironment, IsAsNeededIfItRoundsToNearestAndKeepsSubnormals) {
  for (const HostEnvironment& e : HostEnvironments()) {
    if (e.traps != 0) continue;
    bool as_needed = false;
    {
      const Hosted host(e);
      as_needed = tpa::FloatEnvironment().as_needed();
    }
    EXPECT_EQ(as_needed, e.rounding == FE_TONEAREST && !e.flush) << e.name;
  }
}

#endif

}  // namespace
}  // namespace float_environment_test
