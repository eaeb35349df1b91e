// SPDX-License-Identifier: MIT
// Proofs that stars do not meet themselves, against tests of each pair of triangles.
#include "geometry/star.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/predicates.h"
#include "oracle/lattice_points.h"
#include "support/share.h"

namespace star_test {
namespace {

using namespace lattice_points;
using support::Least;
using support::Share;
using tpa::Vec3;

bool is_proven(const Vec3& p, const std::vector<Vec3>& link) {
  std::vector<Vec3> room = link;
  room.resize(std::max<size_t>(room.size(), tpa::star_room));
  return tpa::star_is_unfolded(p, room.data(), static_cast<tpa::u32>(link.size()));
}

// Spoke by spoke.
bool is_proven_as_fan(const Vec3& p, const std::vector<Vec3>& link) {
  const auto walk = [&](auto& round) {
    for (size_t i = 0; i < link.size(); ++i) round.add(link[i] - p, link[(i + 1) % link.size()] - p);
  };
  tpa::FanNormal normal;
  walk(normal);
  tpa::FanTurns turns(normal);
  walk(turns);
  return turns.unfolded();
}

bool star_meets_itself(const Vec3& p, const std::vector<Vec3>& link) {
  const size_t n = link.size();
  for (size_t i = 0; i < n; ++i) {
    for (size_t j = i + 1; j < n; ++j) {
      const Vec3 &a1 = link[i], &a2 = link[(i + 1) % n], &b1 = link[j], &b2 = link[(j + 1) % n];
      if ((i + 1) % n == j && tpa::triangles_meet_beyond_edge(p, a2, a1, b2)) return true;
      if ((j + 1) % n == i && tpa::triangles_meet_beyond_edge(p, b2, b1, a2)) return true;
      if ((i + 1) % n != j && (j + 1) % n != i && tpa::triangles_meet_beyond_vertex(p, a1, a2, b1, b2)) return true;
    }
  }
  return false;
}
// A star with n corners, `rounds` times round p, raised and shaken by `rough`, turned at random.
std::vector<Vec3> star(Random& random, const Vec3& p, size_t n, int rounds, double rough) {
  const double t = 6.283185307179586, a = t * random.unit(), b = t * random.unit(), slope = random.unit() - 0.5;
  std::vector<Vec3> link;
  for (size_t i = 0; i < n; ++i) {
    const double angle = t * rounds * (double(i) + rough * (random.unit() - 0.5)) / double(n);
    const double r = 1 + rough * (random.unit() - 0.5);
    const double x = r * std::cos(angle), y = r * std::sin(angle), z = slope * r + rough * (random.unit() - 0.5);
    const double y2 = y * std::cos(a) - z * std::sin(a), z2 = y * std::sin(a) + z * std::cos(a);
    link.push_back(p + Vec3{x * std::cos(b) - z2 * std::sin(b), y2, x * std::sin(b) + z2 * std::cos(b)});
  }
  return link;
}

TEST(Stars, ProvenOnesDoNotMeetThemselves) {
  Random random;
  int proven = 0, folded = 0;
  for (int i = 0; i < Share(100000); ++i) {
    const size_t n = static_cast<size_t>(3 + random.upto(6));
    Vec3 p = {random.unit(), random.unit(), random.unit()};
    std::vector<Vec3> link;
    if (i % 3 == 0) {  // lattice, often flat
      p = vec(random.point(4));
      for (size_t k = 0; k < n; ++k) link.push_back(vec(random.point(4)));
      if (i % 2) p.z = 2;
      for (auto& l : link) l.z = i % 2 ? 2 : l.z;
    } else {
      link = star(random, p, n, i % 5 == 0 ? 2 : 1, i % 3 == 1 ? 0.5 : 3.0);
    }
    const bool meets = star_meets_itself(p, link);
    const bool unfolded = is_proven(p, link);
    proven += unfolded;
    folded += meets;
    ASSERT_FALSE((unfolded || is_proven_as_fan(p, link)) && meets) << "seed " << seed << " case " << i;
  }
  EXPECT_GT(proven, Least(10000));
  EXPECT_GT(folded, Least(10000));
}

TEST(Stars, SmoothOnesAreProven) {
  Random random;
  for (int i = 0; i < Share(20000); ++i) {
    const size_t n = static_cast<size_t>(3 + random.upto(tpa::star_is_unfolded_limit - 3));
    const Vec3 p = {10 * random.unit(), random.unit(), -random.unit()};
    const auto link = star(random, p, n, 1, n < 8 ? 0.2 : 0.02);
    ASSERT_TRUE(is_proven(p, link)) << "seed " << seed << " case " << i;
    if (n < 5) continue;  // two rounds of three or four corners are a single round the other way
    const auto twice = star(random, p, n, 2, 0.02);
    ASSERT_FALSE(is_proven(p, twice)) << "seed " << seed << " case " << i;
  }
}

TEST(Stars, SmoothFansOfAnySizeAreProven) {
  Random random;
  for (int i = 0; i < Share(2000); ++i) {
    const size_t n = static_cast<size_t>(5 + random.upto(495));
    const Vec3 p = {10 * random.unit(), random.unit(), -random.unit()};
    const auto once = star(random, p, n, 1, 0.2 / static_cast<double>(n));
    ASSERT_TRUE(is_proven_as_fan(p, once)) << "seed " << seed << " case " << i;
    const auto twice = star(random, p, n, 2, 0.2 / static_cast<double>(n));
    ASSERT_FALSE(is_proven_as_fan(p, twice)) << "seed " << seed << " case " << i;
    auto folded = once;
    std::swap(folded[n / 3], folded[n / 2]);
    ASSERT_FALSE(is_proven_as_fan(p, folded)) << "seed " << seed << " case " << i;
  }
}

// All spokes but the last point in nearly the same direction, often along an axis, and the last points the other way:
// two turns are about pi, and the others often no larger than rounding errors.
std::vector<Vec3> nearly_flat_star(Random& random, const Vec3& p) {
  const double pi = 3.141592653589793;
  const size_t n = static_cast<size_t>(3 + random.upto(4));
  const double turn = random.upto(1) == 0 ? pi / 4 * static_cast<double>(random.upto(7)) : 2 * pi * random.unit();
  const double step = std::ldexp(random.unit(), -static_cast<int>(random.upto(55)));
  const double across = pi + (random.upto(1) == 0 ? 0 : random.unit() * static_cast<double>(n - 2) * step);
  const int first = static_cast<int>(random.upto(2)), second = (first + 1) % 3, third = (first + 2) % 3;
  const double slope = random.upto(1) == 0 ? 0 : random.unit() - 0.5;
  std::vector<Vec3> link;
  for (size_t k = 0; k < n; ++k) {
    const double angle = turn + (k + 1 == n ? across : static_cast<double>(k) * step), r = 0.5 + random.unit();
    Vec3 q = p;
    q[first] += r * std::cos(angle), q[second] += r * std::sin(angle), q[third] += slope * r * std::cos(angle);
    if (random.upto(3) == 0)
      for (int axis = 0; axis < 3; ++axis)
        for (long long ulps = random.within(3); ulps != 0; ulps -= ulps > 0 ? 1 : -1)
          q[axis] = std::nextafter(q[axis], ulps > 0 ? 9.0 : -9.0);
    link.push_back(tpa::into_exact_range(q));
  }
  return link;
}

TEST(Stars, RoundingProvesNone) {
  Random random;
  int folded = 0, proven = 0;
  for (int i = 0; i < Share(400000); ++i) {
    Vec3 p = {random.unit(), random.unit(), random.unit()};
    if (random.upto(2) == 0) p = {0, 0, 0};
    const std::vector<Vec3> link = nearly_flat_star(random, p);
    if (!is_proven(p, link) && !is_proven_as_fan(p, link)) {
      ++folded;
      continue;
    }
    ++proven;
    ASSERT_FALSE(star_meets_itself(p, link)) << "seed " << seed << " case " << i;
  }
  EXPECT_GT(proven, Least(10000));
  EXPECT_GT(folded, Least(10000));
}

// The largest number of corners, and one more.
TEST(Stars, AreProvenUpToALimit) {
  for (const size_t n : {size_t{tpa::star_is_unfolded_limit}, size_t{tpa::star_is_unfolded_limit} + 1}) {
    std::vector<Vec3> link;
    for (size_t i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n);
      link.push_back({std::cos(angle), std::sin(angle), 0.25});
    }
    EXPECT_EQ(is_proven({0, 0, 0}, link), n == tpa::star_is_unfolded_limit);
  }
}

TEST(Stars, RegularGridsAreProven) {
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 p = {1, 1, 1};
    const int step[6][2] = {{1, 0}, {1, 1}, {0, 1}, {-1, 0}, {-1, -1}, {0, -1}};
    std::vector<Vec3> link(6, p);
    for (size_t i = 0; i < 6; ++i) {
      link[i][(axis + 1) % 3] += step[i][0];
      link[i][(axis + 2) % 3] += step[i][1];
    }
    EXPECT_TRUE(is_proven(p, link));
    std::swap(link[1], link[2]);
    EXPECT_FALSE(is_proven(p, link));
    link.resize(2);
    EXPECT_FALSE(is_proven(p, link));
  }
}

}  // namespace
}  // namespace star_test
