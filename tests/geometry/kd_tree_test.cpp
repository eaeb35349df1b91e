// SPDX-License-Identifier: MIT
// Points visited by searches in a k-d tree, against a look at all points.
#include "geometry/kd_tree.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "support/share.h"

namespace {

using tpa::u32;

tpa::KdTree TreeOf(const std::vector<tpa::Vec3>& points, std::vector<u32>& order) {
  order.resize(points.size());
  tpa::KdTree tree{points.data(), order.data(), static_cast<u32>(points.size())};
  tpa::build(tree);
  return tree;
}

// On a lattice, where many coordinates and distances are equal.
std::vector<tpa::Vec3> RandomPoints(std::mt19937_64& random) {
  std::vector<tpa::Vec3> points(random() % 200);
  for (tpa::Vec3& p : points)
    for (int k = 0; k < 3; ++k) p[k] = static_cast<double>(random() % 8);
  return points;
}

TEST(KdTree, VisitsAllWithinReachOnce) {
  for (uint64_t seed = 1; seed <= support::Share(500u); ++seed) {
    std::mt19937_64 random(seed);
    const std::vector<tpa::Vec3> points = RandomPoints(random);
    std::vector<u32> order, visited, expected;
    const tpa::KdTree tree = TreeOf(points, order);
    const tpa::Vec3 from{static_cast<double>(random() % 8), static_cast<double>(random() % 8), 0.5};
    const double reach = static_cast<double>(random() % 40);
    tpa::for_each_near(tree, from, reach, [&](u32 i) { visited.push_back(i); });
    for (u32 i = 0; i < points.size(); ++i)
      if (tpa::squared_length(points[i] - from) <= reach) expected.push_back(i);
    std::sort(visited.begin(), visited.end());
    EXPECT_EQ(visited, expected) << "seed " << seed;
  }
}

TEST(KdTree, FindsTheNearestThatWillDo) {
  for (uint64_t seed = 1; seed <= support::Share(500u); ++seed) {
    std::mt19937_64 random(seed);
    const std::vector<tpa::Vec3> points = RandomPoints(random);
    std::vector<u32> order;
    const tpa::KdTree tree = TreeOf(points, order);
    const tpa::Vec3 from{3.3, 4.1, 2.7};
    const auto will_do = [](u32 i) { return i % 3 == 0; };
    double reach = 1e9, expected = 1e9;
    tpa::for_each_near(tree, from, reach, [&](u32 i) {
      if (will_do(i)) reach = std::min(reach, tpa::squared_length(points[i] - from));
    });
    for (u32 i = 0; i < points.size(); ++i)
      if (will_do(i)) expected = std::min(expected, tpa::squared_length(points[i] - from));
    EXPECT_EQ(reach, expected) << "seed " << seed;
  }
}

}  // namespace
