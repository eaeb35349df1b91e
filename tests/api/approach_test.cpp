// SPDX-License-Identifier: MIT
// How far two points of a surface can approach each other in a step: tunnelling within this distance goes unseen.
#include <algorithm>
#include <cmath>

#include "support/share.h"
#include "support/support.h"

namespace approach_test {
namespace {

using namespace support;

// In more digits than the library has.
long double GreatestDifference(const std::vector<long double>& ways) {
  long double most = 0;
  for (size_t a = 0; 3 * a < ways.size(); ++a)
    for (size_t b = 0; b < a; ++b)
      most = std::max(most, std::hypot(ways[3 * a] - ways[3 * b], ways[3 * a + 1] - ways[3 * b + 1],
                                       ways[3 * a + 2] - ways[3 * b + 2]));
  return most;
}

struct Moved {
  tpa_status status = TPA_OK;
  tpa_report report = Sized<tpa_report>();
  std::vector<long double> ways;  // zero without a target
};

// Moves some vertices of m, every vertex or about one in ten, from a mesh not moved before.
Moved MoveAtRandom(const Mesh& m, bool all, double common, Random& random) {
  Arena arena(ConfigFor(m), m);
  Moved moved;
  moved.ways.assign(m.positions.size(), 0);
  std::vector<uint32_t> ids;
  std::vector<double> targets;
  for (size_t v = 0; 3 * v < m.positions.size(); ++v) {
    if (!all && Uniform(random, 0, 1) < 0.9) continue;
    ids.push_back(static_cast<uint32_t>(v));
    for (size_t i = 3 * v; i < 3 * v + 3; ++i) {
      targets.push_back(m.positions[i] + common + Uniform(random, -0.01, 0.01));
      moved.ways[i] = static_cast<long double>(targets.back()) - static_cast<long double>(m.positions[i]);
    }
  }
  moved.status = MoveSome(*arena, ids, targets);
  if (moved.status == TPA_OK) moved.status = tpa_step(*arena, nullptr, &moved.report, nullptr);
  return moved;
}

// Two spheres change places: nothing meets at the end, and only the report tells.
TEST(Approach, TellsOfPartsThatPassThroughEachOtherUnseen) {
  const Mesh left = Sphere({-2, 0, 0}, 0.5, 6);
  const Mesh m = Together({left, Sphere({2, 0, 0}, 0.5, 6)});
  Arena arena(ConfigFor(m), m);
  std::vector<double> targets = m.positions;
  for (size_t i = 0; i < targets.size(); i += 3) targets[i] += i < left.positions.size() ? 4 : -4;
  ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
  EXPECT_EQ(report.contacts, 0u);
  EXPECT_DOUBLE_EQ(report.approach, 8);
}

TEST(Approach, BoundsTheDifferenceOfAllPairsOfWays) {
  const Mesh m = Sphere({0, 0, 0}, 1, 6);
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    const bool all = seed % 2 == 1;
    const Moved moved = MoveAtRandom(m, all, all ? 5 : 0, random);
    ASSERT_EQ(moved.status, TPA_OK) << seed;
    ASSERT_EQ(moved.report.rolled_back_vertices, 0u) << seed;
    const long double most = GreatestDifference(moved.ways), bound = moved.report.approach;
    EXPECT_GE(bound, most) << seed;
    EXPECT_LE(bound, 2 * most) << seed;
  }
}

// Two spheres on their way towards each other approach by exactly the bound, except for its rounding.
TEST(Approach, IsRoundedUp) {
  const Mesh left = Sphere({-2, 0, 0}, 0.5, 3);
  const Mesh m = Together({left, Sphere({2, 0, 0}, 0.5, 3)});
  for (uint64_t seed = 1; seed <= Share(200u); ++seed) {
    Random random(seed);
    const Point way = RandomPoint(random, -1, 1);
    Arena arena(ConfigFor(m), m);
    std::vector<double> targets = m.positions;
    std::vector<long double> ways;
    for (size_t i = 0; i < targets.size(); ++i) {
      targets[i] += (i < left.positions.size() ? 1 : -1) * way[i % 3];
      ways.push_back(static_cast<long double>(targets[i]) - static_cast<long double>(m.positions[i]));
    }
    ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
    auto report = Sized<tpa_report>();
    ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
    const long double most = GreatestDifference(ways), bound = report.approach;
    EXPECT_GE(bound, most) << seed;
    EXPECT_LE(bound, most * (1 + 1e-14L)) << seed;
  }
}

TEST(Approach, IsNothingWhereAllMoveAlikeOrNoneMoves) {
  const Mesh m = Sphere({0, 0, 0}, 1, 6);
  Arena arena(ConfigFor(m), m);
  auto report = Sized<tpa_report>();
  ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
  EXPECT_EQ(report.approach, 0);
  std::vector<double> targets = m.positions;
  for (double& x : targets) x += 1;
  ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
  ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
  EXPECT_LT(report.approach, 1e-14);
}

}  // namespace
}  // namespace approach_test
