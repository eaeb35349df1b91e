// SPDX-License-Identifier: MIT
// Smoothing with much in the way: vertices go back in several rounds, each of them once.
#include <gtest/gtest.h>

#include <cmath>

#include "support/share.h"
#include "support/support.h"

namespace settle_test {
namespace {

using namespace support;

// Smooths some vertices once: no faces meet then, and the report tells how many vertices have moved.
uint32_t CountMoved(const Mesh& before, const std::vector<uint32_t>& vertices) {
  const Arena arena(ConfigFor(before), before);
  auto options = Sized<tpa_smooth_options>();
  options.iterations = 1;
  options.vertices = vertices.data();
  options.count = static_cast<uint32_t>(vertices.size());
  auto report = Sized<tpa_report>();
  EXPECT_EQ(tpa_smooth(*arena, &options, nullptr, &report, nullptr), TPA_OK);
  const Mesh after = MeshOf(*arena);
  uint32_t moved = 0;
  for (const uint32_t v : vertices) moved += PositionOf(before, v) != PositionOf(after, v) ? 1u : 0u;
  EXPECT_EQ(report.moved, moved);
  EXPECT_TRUE(AllMeetingPairs(after).empty());
  return moved;
}

// A noisy sphere within a copy that is slightly larger. Where some vertices lose their noise, the sheets meet.
TEST(Settling, CountsTheVerticesThatHaveMoved) {
  uint32_t kept = 0, back = 0;
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    const Mesh inner =
        Mapped(Sphere({0, 0, 0}, 1, 6), [&](const Point& p) { return Scaled(Uniform(random, .97, 1.03), p); });
    const Mesh before = Together({inner, Mapped(inner, [](const Point& p) { return Scaled(1.01, p); })});
    std::vector<uint32_t> vertices;
    for (uint32_t v = 0; v < VertexCount(before); ++v)
      if (random() % 2 == 0) vertices.push_back(v);
    const uint32_t moved = CountMoved(before, vertices);
    ASSERT_FALSE(HasFailure()) << "seed " << seed;
    kept += moved;
    back += static_cast<uint32_t>(vertices.size()) - moved;
  }
  EXPECT_GT(kept, Least(500u));
  EXPECT_GT(back, Least(500u));
}

// A hat: two tips over a ring in the plane z = 0, the lower tip first.
Mesh Hat(uint32_t sides, double radius, double low, double high) {
  Mesh m;
  m.positions = {0, 0, low, 0, 0, high};
  for (uint32_t i = 0; i < sides; ++i) {
    const double turn = 2 * pi * i / sides;
    const uint32_t a = 2 + i, b = 2 + (i + 1) % sides;
    m.positions.insert(m.positions.end(), {radius * std::cos(turn), radius * std::sin(turn), 0});
    m.triangles.insert(m.triangles.end(), {0, b, a, 1, a, b});
  }
  return m;
}

// A round takes a tip to some three fifths of its height. So the upper tip of the inner hat turns the hat inside out,
// and goes back. It is met there by the lower tip of the outer hat, which then goes back as well.
TEST(Settling, CountsABodyThatGoesBackOnce) {
  for (uint32_t sides = 3; sides < 9; ++sides) {
    const Mesh inner = Hat(sides, 1, 1, 1.1), outer = Hat(sides, 1.5, 1.7, 2);
    const uint32_t of_outer = VertexCount(inner);
    EXPECT_EQ(CountMoved(Together({inner, outer}), {1}), 0u);
    EXPECT_EQ(CountMoved(Together({inner, outer}), {of_outer}), 0u);
    EXPECT_EQ(CountMoved(outer, {0}), 1u);
    EXPECT_EQ(CountMoved(Together({inner, outer}), {1, of_outer}), 0u);
  }
}

}  // namespace
}  // namespace settle_test
