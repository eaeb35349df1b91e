// SPDX-License-Identifier: MIT
// New vertices too close to their neighbours: one on a fine ball, at a known distance from the nearest.
#include "islands/tidy_cut.h"

#include <cmath>

#include "edit/bisect.h"
#include "islands/rules.h"
#include "oracle/triangle_distance.h"
#include "support/open_island.h"

namespace tidy_cut_test {
namespace {

using namespace support;

constexpr double just_less = 1 - 1e-9, just_more = 1 + 1e-9, plenty = 1e300;

// A ball with one vertex a quarter of an edge from another.
struct Close {
  Mesh ball = Sphere({0, 0, 0}, 1, 8);
  double distance = 0;

  explicit Close(double scale) {
    ball = Mapped(ball, [&](const Point& p) { return Scaled(scale, p); });
    const uint32_t v = ball.triangles[0], u = ball.triangles[1];
    const Point from = PositionOf(ball, u), to = Sum(Scaled(.75, from), Scaled(.25, PositionOf(ball, v)));
    for (size_t i = 0; i < 3; ++i) ball.positions[3 * v + i] = to[i];
    distance = Distance(from, to);
  }
};

struct Tidied {
  Mesh before, after;
  tpa::RegionChange region;
  double distance = 0;  // of both close vertices from the face in contact, the lesser
  bool Merged() const { return VertexCount(after) < VertexCount(before); }
};

// The ball is new, beside an idle one with an edge as short.
Tidied Tidy(double scale, double spacing_of_distance, double bound = plenty) {
  const Close close(scale);
  OpenIsland island(Mapped(close.ball, [&](const Point& p) { return Sum(p, {9 * scale, 0, 0}); }));
  island.Make(close.ball);
  island.t.met.faces.add(0);  // of the idle ball
  tpa::Attempt a = island.Attempt(cut_attempt, bound);
  Tidied t{island.Now(), {}, {}};
  tpa::tidy_cut(a, {spacing_of_distance * close.distance, 0, 0});
  t.after = island.Now();
  t.region = a.region;
  const Point corner[3] = {PositionOf(t.before, t.before.triangles[0]), PositionOf(t.before, t.before.triangles[1]),
                           PositionOf(t.before, t.before.triangles[2])};
  const auto far = [&](uint32_t v) { return std::sqrt(SquaredDistanceToTriangle(PositionOf(close.ball, v), corner)); };
  t.distance = std::min(far(close.ball.triangles[0]), far(close.ball.triangles[1]));
  EXPECT_EQ(FaultOf(t.after), "");
  EXPECT_LE(VertexCount(t.before) - VertexCount(t.after), 1u);
  EXPECT_EQ(island.w.near_faces.hubs, nullptr);
  return t;
}

TEST(NewVertices, MergeIfCloserThanHalfTheSpacing) {
  EXPECT_EQ(tpa::closest_share, 0.5);
  for (double scale : {1.0, 1e-6, 1e6}) {
    EXPECT_TRUE(Tidy(scale, 2 * just_more).Merged()) << scale;
    EXPECT_FALSE(Tidy(scale, 2 * just_less).Merged()) << scale;
  }
}

TEST(NewVertices, MergeWithinTheLedgerAndTellTheChange) {
  const Tidied t = Tidy(1, 2 * just_more);
  ASSERT_TRUE(t.Merged());
  EXPECT_NEAR(t.region.gained - t.region.lost, 6 * (TopologyOf(t.after).Volume() - TopologyOf(t.before).Volume()),
              1e-9);
  EXPECT_GT(t.region.reach, t.distance);
  EXPECT_LT(t.region.reach, t.distance + .8);
  const double volume = t.region.volume();
  EXPECT_GT(volume, 0);
  EXPECT_TRUE(Tidy(1, 2 * just_more, volume / tpa::merge_share * just_more).Merged());
  // The other of both vertices goes for another volume, if that is less.
  const Tidied less = Tidy(1, 2 * just_more, volume / tpa::merge_share * just_less);
  EXPECT_LT(less.region.volume(), volume);
  const Tidied none = Tidy(1, 2 * just_more, 0);
  EXPECT_FALSE(none.Merged());
  EXPECT_EQ(none.after.positions, none.before.positions);
  EXPECT_EQ(none.region.volume(), 0);
}

// Between the ends of an old edge a new vertex lies near one end.
TEST(NewVertices, MergeIntoOldOnesWhichKeepTheirPlaces) {
  const Mesh ball = Sphere({0, 0, 0}, 1, 6);
  for (bool merges : {true, false}) {
    OpenIsland island(ball);
    tpa::Edit& e = island.w.edit;
    const uint32_t h = 0, u = tpa::tail(e.mesh, h);
    const tpa::Vec3 from = e.mesh.position[u], to = e.mesh.position[tpa::head(e.mesh, h)];
    const double distance = .1 * tpa::length(to - from);
    const uint32_t v =
        tpa::new_vertex(e, from + .1 * (to - from), tpa::blend_origins(e.mesh, u, tpa::head(e.mesh, h), .1));
    ASSERT_TRUE(tpa::split_edge(e, island.w.near_faces, h, v));
    ASSERT_EQ(VertexCount(island.Now()), VertexCount(ball) + 1);
    tpa::Attempt a = island.Attempt(cut_attempt, plenty);
    tpa::tidy_cut(a, {2 * distance * (merges ? just_more : just_less), 0, 0});
    const Mesh now = island.Now();
    EXPECT_EQ(FaultOf(now), "");
    EXPECT_EQ(VertexCount(now), VertexCount(ball) + (merges ? 0 : 1));
    for (uint32_t old = 0; old < VertexCount(ball); ++old) EXPECT_EQ(PositionOf(now, old), PositionOf(ball, old));
  }
}

TEST(OldVertices, StayHoweverCloseTheyAre) {
  const Close close(1);
  OpenIsland island(close.ball);
  for (uint32_t v = 0; v < VertexCount(close.ball); ++v) tpa::touch_vertex(island.w.edit, v);
  tpa::Attempt a = island.Attempt(cut_attempt, plenty);
  tpa::tidy_cut(a, {10 * close.distance, 0, 0});
  EXPECT_EQ(island.Now().positions, close.ball.positions);
  EXPECT_EQ(a.region.volume(), 0);
}

TEST(Specks, GoBeforeVerticesMerge) {
  OpenIsland island(Sphere({9, 0, 0}, 1, 3));
  island.Make(Sphere({0, 0, 0}, .1, 3));
  tpa::Attempt a = island.Attempt(cut_attempt, plenty);
  tpa::tidy_cut(a, {1, 0, 0});
  EXPECT_EQ(TopologyOf(island.Now()).components.size(), 1u);
  EXPECT_EQ(a.region.gained, 0);
}

}  // namespace
}  // namespace tidy_cut_test
