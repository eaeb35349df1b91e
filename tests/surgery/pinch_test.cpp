// SPDX-License-Identifier: MIT
// A square hole is cut along its rim and capped: volumes by the oracle, places by hand.
#include "surgery/pinch.h"

#include <cmath>

#include "oracle/triangle_distance.h"
#include "support/open_island.h"
#include "support/plates.h"

namespace pinch_test {
namespace {

using namespace support;

constexpr double plenty = 1e300;

struct Pinched {
  tpa::PinchOutcome outcome;
  tpa::RegionChange region;
  Mesh before, after;
};

const Mesh frame = Frame(1, 3, 2);

// The rim of its hole at the top, against the clock from above: on its left is the hole.
tpa::ShortLoop RimOf(const tpa::Mesh& m) {
  const auto vertex_at = [](const Point& p) {
    for (uint32_t v = 0; v < VertexCount(frame); ++v)
      if (PositionOf(frame, v) == p) return v;
    return tpa::none;
  };
  const uint32_t corner[] = {vertex_at({3, 3, 2}), vertex_at({4, 3, 2}), vertex_at({4, 4, 2}), vertex_at({3, 4, 2})};
  tpa::ShortLoop loop;
  for (size_t i = 0; i < 4; ++i) loop.half_edge[loop.count++] = tpa::find_edge(m, corner[i], corner[(i + 1) % 4]);
  return loop;
}

// Does the tree of near faces find each face at its corners?
void ExpectFound(tpa::Workspace& w) {
  const tpa::Mesh& m = w.edit.mesh;
  for (uint32_t h = 0; h < 3 * m.face_count; ++h) {
    if (!tpa::face_lives(m, tpa::face_of(h))) continue;
    const tpa::Vec3& p = m.position[m.corner[h]];
    bool found = false;
    tpa::for_each_near(w.near_faces, tpa::box_of(p, p, p), [&](uint32_t f) { found = found || f == tpa::face_of(h); });
    EXPECT_TRUE(found) << h;
  }
}

Pinched Pinch(double most, const Mesh& m) {
  OpenIsland island(m);
  tpa::Workspace& w = island.w;
  Pinched p{tpa::PinchOutcome::blocked, {}, island.Now(), {}};
  island.t.met.faces.add(TriangleCount(frame));  // of the obstacle, or none
  p.region.met = &island.t.met;
  p.outcome = tpa::pinch(w.edit, w.near_faces, RimOf(w.edit.mesh), w.clusters, w.closing, {100, {}},
                         w.relocation.face_mark, most, p.region);
  p.region.met = nullptr;
  p.after = island.Now();
  ExpectFound(w);
  for (uint32_t f = 0; f < w.edit.mesh.face_count; ++f) EXPECT_EQ(w.relocation.face_mark[f], 0);
  return p;
}
Pinched Pinch(double most, double scale = 1, const Mesh& obstacle = Sphere({0, 0, 50}, 1, 3)) {
  return Pinch(most, Mapped(Together({frame, obstacle}), [&](const Point& p) { return Scaled(scale, p); }));
}

void ExpectUnchanged(const Pinched& p) {
  EXPECT_TRUE(p.outcome == tpa::PinchOutcome::blocked || p.outcome == tpa::PinchOutcome::dear);
  EXPECT_EQ(p.before.positions, p.after.positions);
  EXPECT_EQ(p.before.triangles, p.after.triangles);
  EXPECT_EQ(p.region.volume(), 0);
}
void ExpectClosed(const Pinched& p) {
  EXPECT_EQ(p.outcome, tpa::PinchOutcome::done);
  EXPECT_EQ(FaultOf(p.after), "");
  EXPECT_EQ(TopologyOf(p.before).Genus(), 1);
  EXPECT_EQ(TopologyOf(p.after).Genus(), 0);
}

// The farthest that a vertex at the rim is now from its corner.
double FarthestParted(const Pinched& p, double scale) {
  double far = 0;
  for (uint32_t v = 0; v < VertexCount(p.after); ++v) {
    double nearest = plenty;
    for (uint32_t u = 0; u < VertexCount(p.before); ++u)
      nearest = std::min(nearest, Distance(PositionOf(p.after, v), PositionOf(p.before, u)));
    far = std::max(far, nearest);
  }
  return far / scale;
}

TEST(Pinch, ClosesAHoleAndTellsTheChangeOfTheVolume) {
  for (double scale : {1.0, 1e-6, 1e6}) {
    const Pinched p = Pinch(plenty, scale);
    ExpectClosed(p);
    const double change = TopologyOf(p.after).Volume() - TopologyOf(p.before).Volume(), cube = scale * scale * scale;
    EXPECT_NEAR(p.region.gained - p.region.lost, 6 * change, 1e-9 * cube);
    EXPECT_GT(p.region.volume(), .01 * cube);
  }
}

// Of rims in no plane, caps on both sides have a volume between them where each takes another diagonal: six times
// among these.
TEST(Pinch, TellsTheChangeOfTheVolumeOfCrookedHolesToo) {
  int closed = 0;
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    const Mesh crooked = Mapped(frame, [&](const Point& p) { return Sum(p, RandomPoint(random, -.45, .45)); });
    if (!AllMeetingPairs(crooked).empty()) continue;
    const Pinched p = Pinch(plenty, crooked);
    if (p.outcome != tpa::PinchOutcome::done) continue;
    ++closed;
    ExpectClosed(p);
    EXPECT_NEAR(p.region.gained - p.region.lost, 6 * (TopologyOf(p.after).Volume() - TopologyOf(p.before).Volume()),
                1e-9)
        << seed;
  }
  EXPECT_GT(closed, 50);
}

// Down the walls of the hole, by an eighth of their shortest edge.
TEST(Pinch, PartsBothSidesByAnEighthOfAnEdge) {
  for (double scale : {1.0, 1e-6, 1e6}) EXPECT_NEAR(FarthestParted(Pinch(plenty, scale), scale), 1. / 8, 1e-9);
}

// From the obstacle above: farther than the rim, down the walls of the hole, and not beyond their foot.
TEST(Pinch, ReachesAsFarAsItsCapsAndMoves) {
  for (double scale : {1.0, 1e-6, 1e6}) {
    const Pinched p = Pinch(plenty, scale);
    const size_t f = frame.triangles.size();
    const Point t[3] = {PositionOf(p.before, p.before.triangles[f]), PositionOf(p.before, p.before.triangles[f + 1]),
                        PositionOf(p.before, p.before.triangles[f + 2])};
    const auto far = [&](const Point& at) { return std::sqrt(SquaredDistanceToTriangle(Scaled(scale, at), t)); };
    EXPECT_GE(p.region.reach, far({3, 3, 2}) * (1 - 1e-9));
    EXPECT_LE(p.region.reach, far({0, 0, 0}) * (1 + 1e-9));
  }
}

TEST(Pinch, StaysWithinItsBound) {
  const double whole = Pinch(plenty).region.volume();
  EXPECT_NEAR(Pinch(whole * (1 + 1e-9)).region.volume(), whole, 1e-12);
  // Next, both sides part by a thousandth.
  const Pinched less = Pinch(whole * (1 - 1e-9));
  ExpectClosed(less);
  EXPECT_NEAR(FarthestParted(less, 1), 1. / 1024, 1e-9);
  const double least = less.region.volume();
  EXPECT_LT(least, .1 * whole);
  ExpectClosed(Pinch(least * (1 + 1e-9)));
  EXPECT_LT(Pinch(least * (1 - 1e-9)).region.volume(), least);
  ExpectUnchanged(Pinch(.01 * least));
  ExpectUnchanged(Pinch(0));
}

TEST(Pinch, LeavesAHoleOpenIfAnotherBodyGoesThrough) {
  ExpectUnchanged(Pinch(plenty, 1, Box({3.4, 3.4, -1}, {3.6, 3.6, 3}, 1)));
  ExpectClosed(Pinch(plenty, 1, Box({3.4, 3.4, 3}, {3.6, 3.6, 5}, 1)));
}

TEST(Pinch, IsTheSameBesideIdleBodies) {
  const Pinched alone = Pinch(plenty), beside = Pinch(plenty, 1, Sphere({0, 0, -1e6}, 1e5, 10));
  EXPECT_EQ(alone.region.lost, beside.region.lost);
  EXPECT_EQ(alone.region.gained, beside.region.gained);
}

}  // namespace
}  // namespace pinch_test
