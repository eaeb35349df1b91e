// SPDX-License-Identifier: MIT
// Thin tunnels and handles that an island has made: square holes and bars of known sizes, just thin enough to be
// closed, or just not.
#include "islands/close_tunnels.h"

#include <cmath>

#include "islands/handles_made.h"
#include "islands/rules.h"
#include "support/open_island.h"
#include "support/plates.h"

namespace close_tunnels_test {
namespace {

using namespace support;

constexpr double just_less = 1 - 1e-3, just_more = 1 + 1e-3, plenty = 1e300, huge = 1e6;

Mesh Scaled(const Mesh& m, double by) {
  return Mapped(m, [&](const Point& p) { return support::Scaled(by, p); });
}
std::vector<uint32_t> Numbers(uint32_t count) {
  std::vector<uint32_t> numbers(count);
  for (uint32_t v = 0; v < count; ++v) numbers[v] = v;
  return numbers;
}

// An island puts `made` in the place of a component, beside an idle ball. The genus of all afterwards.
int64_t GenusAfter(const Mesh& before, const Mesh& made, const tpa::CutSizes& sizes, uint32_t attempt = cut_attempt,
                   double bound = plenty) {
  OpenIsland island(Together({before, Sphere({0, 0, -9}, 1, 3)}));
  island.Remove(Numbers(VertexCount(before)));
  island.Make(made);
  tpa::Attempt a = island.Attempt(attempt, bound);
  const Mesh given = island.Now();
  EXPECT_EQ(tpa::close_tunnels(a, sizes, tpa::handles_made(a.t)), tpa::Outcome::clean);
  const Mesh now = island.Now();
  EXPECT_EQ(FaultOf(now), "");
  EXPECT_LE(a.region.volume(), bound);
  EXPECT_NEAR(a.region.gained - a.region.lost, 6 * (TopologyOf(now).Volume() - TopologyOf(given).Volume()),
              1e-9 * TopologyOf(given).Volume());
  return TopologyOf(now).Genus();
}

const Mesh ball = Sphere({0, 0, 0}, 1, 3);

class TunnelsOfSize : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Scaled, TunnelsOfSize, testing::Values(1.0, 1e-3, 1e3));

// A circle of the area of the hole is as long as eight triangles: 2 sqrt(pi) sides of the hole.
TEST_P(TunnelsOfSize, CloseUpToEightTrianglesRound) {
  const double side = GetParam(), triangle = 2 * std::sqrt(pi) / 8 * side;
  const Mesh frame = Scaled(Frame(1, 3, 2), side);
  EXPECT_EQ(GenusAfter(ball, frame, {0, just_more * triangle, huge}), 0);
  EXPECT_EQ(GenusAfter(ball, frame, {0, just_less * triangle, huge}), 1);
}

// Its length, four sides, is that of four of the longest edges, or of eight triangles.
TEST_P(TunnelsOfSize, CloseUpToFourLongestEdgesIfFlat) {
  const double side = GetParam();
  const Mesh frame = Scaled(Frame(1, 3, 2), side);
  EXPECT_EQ(GenusAfter(ball, frame, {0, .47 * side, just_more * side}), 0);
  EXPECT_EQ(GenusAfter(ball, frame, {0, .47 * side, just_less * side}), 1);
  EXPECT_EQ(GenusAfter(ball, frame, {0, just_more * .5 * side, 0}), 0);
  EXPECT_EQ(GenusAfter(ball, frame, {0, just_less * .5 * side, 0}), 1);
}

// Round a bar it is four widths.
TEST_P(TunnelsOfSize, OfHandlesCloseUpToFourTrianglesRound) {
  const double bar = GetParam();
  const Mesh frame = Scaled(Frame(20, 1, 1), bar);
  EXPECT_EQ(GenusAfter(ball, frame, {0, just_more * bar, 0}), 0);
  EXPECT_EQ(GenusAfter(ball, frame, {0, just_less * bar, 0}), 1);
  // A bridge of the paper stays.
  EXPECT_EQ(GenusAfter(ball, frame, {0, 2 * bar, 0}, papers_attempt), 1);
}

TEST_P(TunnelsOfSize, CloseInThePapersWayToo) {
  const double side = GetParam(), triangle = 2 * std::sqrt(pi) / 8 * side;
  const Mesh frame = Scaled(Frame(1, 3, 2), side);
  EXPECT_EQ(GenusAfter(ball, frame, {0, just_more * triangle, huge}, papers_attempt), 0);
  EXPECT_EQ(GenusAfter(ball, frame, {0, just_less * triangle, huge}, papers_attempt), 1);
}

// Two equal holes: as many are closed as there are more than before.
TEST(Tunnels, CloseAsOftenAsAnIslandHasMadeHandles) {
  const Mesh two = Plate({"xxxxx", "x x x", "xxxxx"}, {0, 3, 4, 7, 8, 11}, {0, 3, 4, 7}, 2);
  const Mesh ring = Torus({0, 0, 0}, 3, 1, 12, 6);
  ASSERT_EQ(TopologyOf(two).Genus(), 2);
  EXPECT_EQ(GenusAfter(ball, two, {0, .6, huge}), 0);
  EXPECT_EQ(GenusAfter(ring, two, {0, .6, huge}), 1);
  EXPECT_EQ(GenusAfter(two, two, {0, .6, huge}), 2);
}

// Is no triangle seen from above, at a place without a vertex or edge?
bool IsOpenAt(const Mesh& m, double x, double y) {
  for (size_t f = 0; f < TriangleCount(m); ++f) {
    const uint32_t* v = m.triangles.data() + 3 * f;
    const Point p = PositionOf(m, v[0]), q = PositionOf(m, v[1]), r = PositionOf(m, v[2]);
    const auto turn = [&](const Point& s, const Point& t) {
      return (t[0] - s[0]) * (y - s[1]) - (t[1] - s[1]) * (x - s[0]) > 0;
    };
    if (turn(p, q) == turn(q, r) && turn(q, r) == turn(r, p)) return false;
  }
  return true;
}

// The thinner one of two holes, whichever has the lower numbers.
TEST(Tunnels, CloseTheThinnestFirst) {
  const Mesh ring = Torus({0, 0, 0}, 3, 1, 12, 6);
  for (bool mirrored : {false, true}) {
    const std::vector<double> x =
        mirrored ? std::vector<double>{0, 3, 3.2, 6.2, 7.2, 10.2} : std::vector<double>{0, 3, 4, 7, 7.2, 10.2};
    OpenIsland island(Together({ring, Sphere({0, 0, -9}, 1, 3)}));
    island.Remove(Numbers(VertexCount(ring)));
    island.Make(Plate({"xxxxx", "x x x", "xxxxx"}, x, {0, 3, 4, 7}, 2));
    tpa::Attempt a = island.Attempt(cut_attempt, plenty);
    EXPECT_EQ(tpa::close_tunnels(a, {0, .6, huge}, tpa::handles_made(a.t)), tpa::Outcome::clean);
    const Mesh now = island.Now();
    EXPECT_EQ(IsOpenAt(now, .5 * (x[1] + x[2]) + .01, 3.52), !mirrored);
    EXPECT_EQ(IsOpenAt(now, .5 * (x[3] + x[4]) + .01, 3.52), mirrored);
  }
}

// The island makes a handle elsewhere, too thick to be closed, and touches the vertices round the tunnel.
TEST(Tunnels, ThatWereThereStayHoweverThinTheyAre) {
  const Mesh frame = Frame(.01, 3, 2);
  OpenIsland island(Together({frame, Translated(ball, {0, 0, -9})}));
  const uint32_t first = VertexCount(frame);
  std::vector<uint32_t> ball_vertices = Numbers(VertexCount(ball));
  for (uint32_t& v : ball_vertices) v += first;
  island.Remove(ball_vertices);
  island.Make(Torus({0, 0, 90}, 20, 9, 24, 12), {{first, first}, .5f});
  for (uint32_t v = 0; v < VertexCount(frame); ++v) tpa::touch_vertex(island.w.edit, v);
  ASSERT_EQ(tpa::handles_made(island.t), 1);
  tpa::Attempt a = island.Attempt(cut_attempt, plenty);
  EXPECT_EQ(tpa::close_tunnels(a, {0, 1, 0}, tpa::handles_made(a.t)), tpa::Outcome::clean);
  EXPECT_EQ(TopologyOf(island.Now()).Genus(), 2);
}

TEST(Tunnels, DoNotCloseBeyondTheLedger) {
  const Mesh frame = Frame(1, 3, 2);
  EXPECT_EQ(GenusAfter(ball, frame, {0, .6, huge}, cut_attempt, 0), 1);
  EXPECT_EQ(GenusAfter(ball, frame, {0, .6, huge}, cut_attempt, 12), 0);
}

}  // namespace
}  // namespace close_tunnels_test
