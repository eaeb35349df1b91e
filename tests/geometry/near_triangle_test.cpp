// SPDX-License-Identifier: MIT
// Distances from points to triangles, against the oracle's formula; slivers and triangles without area too.
#include "geometry/near_triangle.h"

#include <gtest/gtest.h>

#include <cmath>

#include "oracle/triangle_distance.h"
#include "support/sample_meshes.h"

namespace near_triangle_test {
namespace {

using namespace support;

tpa::Vec3 VecOf(const Point& p) { return {p[0], p[1], p[2]}; }

double DistanceTo(const Point& p, const Point (&t)[3]) {
  const tpa::Vec3 corner[] = {VecOf(t[0]), VecOf(t[1]), VecOf(t[2])};
  return std::sqrt(tpa::squared_distance(VecOf(p), corner));
}

TEST(NearTriangle, IsAsFarAsTheOracleSays) {
  for (double scale : {1.0, 0x1p-90, 0x1p90})
    for (uint64_t seed = 1; seed <= 2000; ++seed) {
      Random random(seed);
      Point t[3], p = Scaled(scale, RandomPoint(random, -2, 2));
      for (Point& corner : t) corner = Scaled(scale, RandomPoint(random, -1, 1));
      EXPECT_NEAR(DistanceTo(p, t), std::sqrt(SquaredDistanceToTriangle(p, t)), 1e-7 * scale) << seed;
    }
}

// Rounding tells no direction across a thin sliver, but brings the point no nearer.
TEST(NearTriangle, OfSliversIsAsFarAsTheOracleSays) {
  for (double thin : {1e-2, 1e-4, 1e-6, 1e-9, 1e-12})
    for (uint64_t seed = 1; seed <= 400; ++seed) {
      Random random(seed);
      Point t[3], p = RandomPoint(random, -2, 2);
      for (Point& corner : t) corner = RandomPoint(random, -1, 1);
      for (size_t i = 0; i < 3; ++i) t[2][i] = 0.5 * (t[0][i] + t[1][i]) + thin * t[2][i];
      const double oracle = std::sqrt(SquaredDistanceToTriangle(p, t));
      EXPECT_GE(DistanceTo(p, t), oracle - 1e-7) << thin << ", seed " << seed;
      if (thin > 1e-7) {
        EXPECT_NEAR(DistanceTo(p, t), oracle, 1e-7) << thin << ", seed " << seed;
      }
    }
}

TEST(NearTriangle, KnowsInsideEdgesAndCorners) {
  const Point t[3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  EXPECT_EQ(DistanceTo({1, 1, -3}, t), 3);
  EXPECT_EQ(DistanceTo({1, 1, 0}, t), 0);
  EXPECT_EQ(DistanceTo({2, -3, 4}, t), 5);
  EXPECT_EQ(DistanceTo({-3, -4, 0}, t), 5);
  EXPECT_EQ(DistanceTo({7, -4, 0}, t), 5);
}

TEST(NearTriangle, WithoutAreaIsAnEdgeOrAPoint) {
  const Point edge[3] = {{0, 0, 0}, {4, 0, 0}, {1, 0, 0}}, point[3] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
  EXPECT_EQ(DistanceTo({2, 3, 4}, edge), 5);
  EXPECT_EQ(DistanceTo({7, 4, 0}, edge), 5);
  EXPECT_EQ(DistanceTo({1, 5, 7}, point), 5);
}

}  // namespace
}  // namespace near_triangle_test
