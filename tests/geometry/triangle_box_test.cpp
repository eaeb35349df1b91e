// SPDX-License-Identifier: MIT
// Triangles proven to be off a box, against points of the triangle: none lies in the box. Triangles off a box by more
// than rounding are proven so, mostly.
#include "geometry/triangle_box.h"

#include <algorithm>

#include "support/share.h"
#include "support/tangle_shapes.h"

namespace {

using namespace support;

tpa::Box BoxRound(const Point& middle, const Point& half) {
  tpa::Box b{};
  for (size_t k = 0; k < 3; ++k) {
    b.low[k] = static_cast<float>(middle[k] - half[k]);
    b.high[k] = static_cast<float>(middle[k] + half[k]);
  }
  return b;
}

// How far a point of the triangle lies from the box at least, over a fine grid of points.
double DistanceFrom(const tpa::Box& b, const tpa::FlatTriangle& t) {
  constexpr int steps = 40;
  double nearest = 1e300;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; i + j <= steps; ++j) {
      double farthest = 0;
      for (size_t k = 0; k < 3; ++k) {
        const double at =
            (double{t.corner[0][k]} * i + double{t.corner[1][k]} * j + double{t.corner[2][k]} * (steps - i - j)) /
            steps;
        farthest = std::max({farthest, double{b.low[k]} - at, at - double{b.high[k]}});
      }
      nearest = std::min(nearest, farthest);
    }
  return nearest;
}

TEST(TrianglesAndBoxes, PointsInTheBoxRuleOutTheProof) {
  int apart = 0, proven = 0, met = 0;
  for (uint64_t seed = 1; seed <= Share(5000u); ++seed) {
    Random random(seed);
    const Point middle = RandomPoint(random, -1, 1), half = RandomPoint(random, 0, .5);
    const tpa::Box box = BoxRound(middle, half);
    // Every other triangle is a needle, many of them past a corner of the box.
    const double width = seed % 2 == 0 ? .01 : 1;
    const Point from = RandomPoint(random, -1.5, 1.5), along = RandomDirection(random), aside = RandomDirection(random);
    const Point corner[] = {from, Sum(from, Scaled(2, along)),
                            Sum(from, Sum(Scaled(1.8, along), Scaled(width, aside)))};
    tpa::FlatTriangle t;
    for (size_t i = 0; i < 3; ++i)
      for (size_t k = 0; k < 3; ++k) t.corner[i][k] = static_cast<float>(std::clamp(corner[i][k], -2., 2.));
    const double distance = DistanceFrom(box, t);
    const bool is_off = tpa::provably_off(t, box);
    ASSERT_FALSE(is_off && distance <= 0) << "seed " << seed;
    met += distance <= 0 ? 1 : 0;
    if (distance < .1) continue;
    ++apart;
    proven += is_off ? 1 : 0;
  }
  EXPECT_GT(met, Share(100));
  EXPECT_GT(apart, Share(500));
  EXPECT_GT(proven, apart * 99 / 100);
}

}  // namespace
