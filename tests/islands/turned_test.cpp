// SPDX-License-Identifier: MIT
// Bodies that turn inside out: wedges whose one end passes through itself, so that a crumb of known volume is left of
// them beside what is inside out.
#include "islands/turned.h"

#include <cmath>

#include "islands/rules.h"
#include "support/open_island.h"

namespace turned_test {
namespace {

using namespace support;

// A bar along x from 0 to 1 with ends of these half widths in y, and a half height in z.
Mesh Bar(double first, double last, double height, int n = 1) {
  return Mapped(Box({0, -1, -1}, {1, 1, 1}, n), [&](const Point& p) {
    return Point{p[0], p[1] * (first + (last - first) * p[0]), p[2] * height};
  });
}
// Of the end at 0, up to where both sides cross.
double CrumbOf(double first, double last, double height) { return 2 * height * first * first / (first - last); }

Mesh InsideOut(Mesh m) {
  for (size_t f = 0; f < TriangleCount(m); ++f) std::swap(m.triangles[3 * f], m.triangles[3 * f + 1]);
  return m;
}

struct Dropped {
  bool is_gone;
  size_t contacts_left;
  tpa::RegionChange region;
  double bound;
};
Dropped Drop(const Mesh& from, const Mesh& to, double left, const Mesh& beside = Sphere({0, 0, 5e7}, 1, 3)) {
  OpenIsland island(Together({from, beside}), Together({to, beside}));
  EXPECT_GE(island.w.detection.pairs.size, VertexCount(from));
  tpa::Attempt a = island.Attempt(cut_attempt, left);
  const size_t vertices = VertexCount(island.Now());
  tpa::drop_turned(a);
  const Mesh now = island.Now();
  EXPECT_EQ(TopologyOf(now).defect, "");
  for (const tpa::Contact& c : island.w.detection.pairs) EXPECT_TRUE(tpa::face_lives(island.w.edit.mesh, c.a));
  EXPECT_EQ(island.w.detection.found, island.w.detection.pairs.size);
  for (uint32_t v = 0; v < island.w.edit.mesh.vertex_count; ++v) EXPECT_EQ(island.w.relocation.vertex_mark[v], 0);
  const bool gone = VertexCount(now) < vertices;
  EXPECT_EQ(VertexCount(now), gone ? VertexCount(beside) : vertices);
  EXPECT_EQ(island.report.removed_patches, gone ? 1u : 0u);
  return {gone, island.w.detection.pairs.size, a.region, a.ledger.bound};
}

// Layers of three hundredths of the faces' mean width on all faces.
double LayersOf(const Mesh& m) {
  double widths = 0, area = 0;
  for (size_t f = 0; f < TriangleCount(m); ++f) {
    const Point a = PositionOf(m, m.triangles[3 * f]), b = PositionOf(m, m.triangles[3 * f + 1]),
                c = PositionOf(m, m.triangles[3 * f + 2]);
    const double twice = Length(Cross(Difference(b, a), Difference(c, a)));
    widths += std::sqrt(twice), area += twice / 2;
  }
  return .03 * widths / TriangleCount(m) * area;
}

// The width of the crumb's end for a crumb of this volume, by halving.
double WidthFor(double volume, double last, double height) {
  double low = 0, high = -last;
  for (int i = 0; i < 60; ++i) (CrumbOf((low + high) / 2, last, height) < volume ? low : high) = (low + high) / 2;
  return low;
}

// Crumbs are sampled at points of a grid, and count rather more than less, by a root of their points: 2 to 5 per cent.
constexpr double surely_less = .92, surely_more = 1.02, plenty = 1e300;

class TurnedOfSize : public testing::TestWithParam<double> {
 protected:
  static Mesh Grown(const Mesh& m) {
    return Mapped(m, [](const Point& p) { return Scaled(GetParam(), p); });
  }
};
INSTANTIATE_TEST_SUITE_P(Scaled, TurnedOfSize, testing::Values(1.0, 1e-6, 1e6));

TEST_P(TurnedOfSize, GoWithAThirdOfTheirVolumeAtMost) {
  const Mesh from = Bar(.1, .1, .5);
  const double third = TopologyOf(from).Volume() / 3;
  EXPECT_NEAR(third, .2 / 3, 1e-12);
  for (double share : {surely_less, surely_more}) {
    const Mesh to = Bar(WidthFor(share * third, -.5, .5), -.5, .5);
    EXPECT_LT(1.5 * third, LayersOf(to));
    EXPECT_EQ(Drop(Grown(from), Grown(to), 0).is_gone, share < 1);
  }
}

TEST_P(TurnedOfSize, GoWithLayersOnTheirFacesAtMost) {
  const Mesh from = Bar(.5, .5, .5, 2);
  for (double share : {surely_less, surely_more}) {
    double width = .2;
    for (int i = 0; i < 50; ++i) width = WidthFor(share * LayersOf(Bar(width, -.5, .5, 2)), -.5, .5);
    const Mesh to = Bar(width, -.5, .5, 2);
    EXPECT_LT(1.5 * LayersOf(to), TopologyOf(from).Volume() / 3);
    EXPECT_EQ(Drop(Grown(from), Grown(to), 0).is_gone, share < 1);
  }
}

TEST_P(TurnedOfSize, GoWithWhatTheLedgerHas) {
  const Mesh from = Grown(Bar(.1, .1, .5)), to = Grown(Bar(.35, -.5, .5));
  const Dropped all = Drop(from, to, plenty);
  ASSERT_TRUE(all.is_gone);
  const double volume = all.region.volume(), crumb = CrumbOf(.35, -.5, .5) * std::pow(GetParam(), 3);
  EXPECT_NEAR(volume, 6 * crumb, .05 * volume);
  EXPECT_EQ(all.region.gained, 0);
  // Beyond the faces by the radius of a ball as large as the crumb.
  const double ball = std::cbrt(volume / (8 * 3.14159265358979));
  EXPECT_GT(all.region.reach, ball * (1 - 1e-9));
  EXPECT_LT(all.region.reach, std::sqrt(3.) * GetParam() + ball);
  const Dropped enough = Drop(from, to, volume * (1 + 1e-9));
  EXPECT_TRUE(enough.is_gone);
  // Crumbs are no part of the body any more: the ledger has for the rest what it had.
  EXPECT_NEAR(enough.bound - enough.region.volume(), volume * (1 + 1e-9), 1e-9 * volume);
  EXPECT_EQ(enough.contacts_left, 0u);
  const Dropped less = Drop(from, to, volume * (1 - 1e-9));
  EXPECT_FALSE(less.is_gone);
  EXPECT_EQ(less.bound, volume * (1 - 1e-9));
  EXPECT_EQ(less.region.volume(), 0);
}

// Where the body is inside out as a whole, nothing of the region goes with it, however far its faces lie.
TEST(Turned, WithoutACrumbChangeNothing) {
  const Mesh to = Bar(1e-9, -.5, .5, 2);
  EXPECT_LT(CrumbOf(1e-9, -.5, .5), 1e-17);
  const Dropped d = Drop(Bar(.5, .5, .5, 2), to, 0);
  EXPECT_TRUE(d.is_gone);
  EXPECT_EQ(d.region.volume(), 0);
  EXPECT_EQ(d.region.reach, 0);
}

TEST(Turned, AreNoBodiesThatKeepTheirSide) {
  EXPECT_FALSE(Drop(Bar(.5, .5, .5), Bar(.5, -.49, .5), plenty).is_gone);
  EXPECT_TRUE(Drop(Bar(.5, .5, .5), Bar(.49, -.5, .5), plenty).is_gone);
  // Inside out before as well.
  EXPECT_FALSE(Drop(InsideOut(Bar(.5, .5, .5)), InsideOut(Bar(.5, -.49, .5)), plenty).is_gone);
}

TEST(Turned, AreNoBodiesThatMeetAnother) {
  const Mesh from = Bar(.5, .5, .5), to = Bar(.1, -.5, .5);
  EXPECT_TRUE(Drop(from, to, plenty, Box({1.1, -1, -1}, {3, 1, 1}, 1)).is_gone);
  EXPECT_FALSE(Drop(from, to, plenty, Box({.9, -1, -1}, {3, 1, 1}, 1)).is_gone);
}

// More vertices than contacts are no heap of folds.
TEST(Turned, HaveAsManyContactsAsVertices) {
  int heaps = 0, others = 0;
  for (int n = 1; n <= 6; ++n) {
    const Mesh from = Bar(.5, .5, .5, n), to = Bar(.1, -.5, .5, n);
    const size_t contacts = AllMeetingPairs(to).size();
    OpenIsland island(Together({from, Sphere({0, 0, 50}, 1, 3)}), Together({to, Sphere({0, 0, 50}, 1, 3)}));
    ASSERT_EQ(island.w.detection.pairs.size, contacts);
    tpa::Attempt a = island.Attempt(cut_attempt, plenty);
    tpa::drop_turned(a);
    const bool gone = TopologyOf(island.Now()).components.size() == 1, is_heap = VertexCount(to) <= contacts;
    EXPECT_EQ(gone, is_heap) << contacts << " contacts of " << VertexCount(to);
    ++(is_heap ? heaps : others);
  }
  EXPECT_GT(heaps, 1);
  EXPECT_GT(others, 0);
}

// Crumbs of a void are what the body gains.
TEST(Turned, VoidsGoAsWell) {
  const Mesh from = InsideOut(Bar(.1, .1, .5)), around = Box({-9, -9, -9}, {9, 9, 9}, 1);
  for (double share : {surely_less, surely_more}) {
    const Mesh to = InsideOut(Bar(WidthFor(share * .2 / 3, -.5, .5), -.5, .5));
    const Dropped d = Drop(from, to, 0, around);
    EXPECT_EQ(d.is_gone, share < 1);
    EXPECT_EQ(d.region.lost, 0);
    if (d.is_gone) {
      EXPECT_NEAR(d.region.gained, 6 * share * .2 / 3, .05 * d.region.gained);
    }
  }
}

TEST(Turned, HaveTheSameEndBesideIdleBodies) {
  const Mesh from = Bar(.1, .1, .5), to = Bar(.2, -.5, .5);
  const Dropped alone = Drop(from, to, 0);
  for (const Mesh& idle : {Sphere({0, 0, 1e6}, 1e5, 10), Sphere({0, 0, 3}, .01, 2), Box({2, -9, -9}, {3, 9, 9}, 3)}) {
    const Dropped beside = Drop(from, to, 0, idle);
    EXPECT_EQ(beside.is_gone, alone.is_gone);
    EXPECT_EQ(beside.region.lost, alone.region.lost);
  }
}

}  // namespace
}  // namespace turned_test
