// SPDX-License-Identifier: MIT
// Boxes of triangles, and queries of ranges of boxes, four at a time, against single boxes.
#include "geometry/box.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace box_test {
namespace {

using Random = std::mt19937;

// On a coarse lattice, so that many boxes touch.
tpa::Box SomeBox(Random& random, uint32_t extent) {
  tpa::Box box;
  for (int k = 0; k < 3; ++k) {
    box.low[k] = static_cast<float>(random() % 12);
    box.high[k] = box.low[k] + static_cast<float>(random() % extent);
  }
  return box;
}

TEST(Boxes, FourAtATimeMeetAsOneByOne) {
  Random random(2);
  constexpr uint32_t count = 203;
  std::vector<float> low[3], high[3];
  for (int k = 0; k < 3; ++k) low[k].resize(count), high[k].resize(count);
  std::vector<tpa::Box> boxes(count);
  for (uint32_t i = 0; i < count; ++i) {
    boxes[i] = SomeBox(random, 4);
    for (int k = 0; k < 3; ++k) low[k][i] = boxes[i].low[k], high[k][i] = boxes[i].high[k];
  }
  const tpa::ConstBoxLanes lanes{{low[0].data(), low[1].data(), low[2].data()},
                                 {high[0].data(), high[1].data(), high[2].data()}};
  int met = 0;
  for (int n = 0; n < 50; ++n) {
    const tpa::Box query = SomeBox(random, 6);
    for (uint32_t at = 0; at + 4 <= count; ++at) {
      const tpa::I4 mask = tpa::lanes_meeting(lanes, at, tpa::broad(query));
      for (int i = 0; i < 4; ++i) {
        const bool meet = tpa::boxes_meet(boxes[at + static_cast<uint32_t>(i)], query);
        EXPECT_EQ(mask[i] != 0, meet);
        met += meet ? 1 : 0;
      }
    }
  }
  EXPECT_GT(met, 100);
}

// Axis by axis, whatever the fourth numbers.
TEST(Boxes, MeetAndUniteAlongThreeAxes) {
  Random random(3);
  const float rest[] = {0, -FLT_MAX, FLT_MAX, std::numeric_limits<float>::quiet_NaN()};
  int met = 0;
  for (int i = 0; i < 20000; ++i) {
    tpa::Box a = SomeBox(random, 8), b = SomeBox(random, 8);
    a.low[3] = rest[random() % 4], a.high[3] = rest[random() % 4];
    b.low[3] = rest[random() % 4], b.high[3] = rest[random() % 4];
    bool meet = true;
    const tpa::Box both = tpa::united(a, b);
    for (int k = 0; k < 3; ++k) {
      meet = meet && a.low[k] <= b.high[k] && b.low[k] <= a.high[k];
      ASSERT_EQ(both.low[k], std::min(a.low[k], b.low[k])) << i;
      ASSERT_EQ(both.high[k], std::max(a.high[k], b.high[k])) << i;
    }
    ASSERT_EQ(tpa::boxes_meet(a, b), meet) << i;
    met += meet;
  }
  EXPECT_GT(met, 2000);
  EXPECT_LT(met, 18000);
}

// The box of a triangle holds its corners, and hardly more, at all admitted magnitudes.
TEST(Boxes, OfTrianglesHoldTheirCorners) {
  Random random(4);
  const auto coordinate = [&] {
    const double digits = static_cast<double>(random()) * 0x1p-32 + static_cast<double>(random()) * 0x1p-64 + 1;
    const int exponent = static_cast<int>(random() % 200) - 100;
    return random() % 8 == 0 ? 0 : std::ldexp(random() % 2 == 0 ? digits : -digits, exponent);
  };
  for (int i = 0; i < 20000; ++i) {
    tpa::Vec3 p[3];
    for (tpa::Vec3& corner : p) corner = {coordinate(), coordinate(), coordinate()};
    const tpa::Box box = tpa::box_of(p[0], p[1], p[2]);
    for (int k = 0; k < 3; ++k) {
      const double low = std::min({p[0][k], p[1][k], p[2][k]}), high = std::max({p[0][k], p[1][k], p[2][k]});
      ASSERT_LE(box.low[k], low) << i;
      ASSERT_GE(box.high[k], high) << i;
      ASSERT_GE(box.low[k], low - 0x1p-21 * std::fabs(low)) << i;
      ASSERT_LE(box.high[k], high + 0x1p-21 * std::fabs(high)) << i;
    }
  }
}

}  // namespace
}  // namespace box_test
