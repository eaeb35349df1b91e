// SPDX-License-Identifier: MIT
// Crumbs of a seam: octahedra and tips of a ring, whose volumes and areas are known by hand, just smaller and just
// larger than a speck may be.
#include "islands/specks.h"

#include <cmath>

#include "islands/rules.h"
#include "oracle/triangle_distance.h"
#include "support/mesh_building.h"
#include "support/open_island.h"

namespace specks_test {
namespace {

using namespace support;

constexpr double just_less = 1 - 1e-9, just_more = 1 + 1e-9;
constexpr double plenty = 1e300;

Mesh Octahedron(double radius, const Point& middle, bool is_void) {
  Mesh m;
  for (const Point& p :
       {Point{1, 0, 0}, Point{0, 1, 0}, Point{-1, 0, 0}, Point{0, -1, 0}, Point{0, 0, 1}, Point{0, 0, -1}})
    AddVertex(m, Sum(middle, Scaled(radius, p)));
  for (size_t i = 0; i < 4; ++i) {
    AddTriangle(m, i, (i + 1) % 4, 4);
    AddTriangle(m, (i + 1) % 4, i, 5);
  }
  if (is_void)
    for (size_t f = 0; f < 8; ++f) std::swap(m.triangles[3 * f], m.triangles[3 * f + 1]);
  return m;
}
double VolumeOf(double radius) { return 4. / 3 * radius * radius * radius; }
double AreaOf(double radius) { return 4 * std::sqrt(3.) * radius * radius; }

// An octahedron that an island has made beside an idle ball.
struct Crumb {
  double radius = 1, scale = 1;
  bool is_void = false;
  uint32_t attempt = cut_attempt;
  double bound = plenty;
};

double FarFromBall(const Crumb& crumb) {
  const Mesh ball = Mapped(Sphere({0, 0, 0}, 1, 4), [&](const Point& p) { return Scaled(crumb.scale, p); });
  const Point t[3] = {PositionOf(ball, ball.triangles[0]), PositionOf(ball, ball.triangles[1]),
                      PositionOf(ball, ball.triangles[2])};
  const Mesh made = Octahedron(crumb.radius, {3 * crumb.scale + crumb.radius, 0, 0}, false);
  double far = 0;
  for (uint32_t v = 0; v < VertexCount(made); ++v)
    far = std::max(far, SquaredDistanceToTriangle(PositionOf(made, v), t));
  return std::sqrt(far);
}

// Is it dropped? Checks all that goes with it.
bool IsDropped(const Crumb& crumb, const tpa::CutSizes& sizes) {
  OpenIsland island(Mapped(Sphere({0, 0, 0}, 1, 4), [&](const Point& p) { return Scaled(crumb.scale, p); }));
  island.Make(Octahedron(crumb.radius, {3 * crumb.scale + crumb.radius, 0, 0}, crumb.is_void));
  tpa::Attempt a = island.Attempt(crumb.attempt, crumb.bound);
  island.t.met.faces.add(0);
  tpa::drop_specks(a, sizes);
  const Topology now = TopologyOf(island.Now());
  EXPECT_EQ(now.defect, "");
  const bool dropped = now.components.size() == 1;
  const double six_volumes = dropped ? 6 * VolumeOf(crumb.radius) : 0;
  EXPECT_NEAR(a.region.lost, crumb.is_void ? 0 : six_volumes, 1e-12 * six_volumes);
  EXPECT_NEAR(a.region.gained, crumb.is_void ? six_volumes : 0, 1e-12 * six_volumes);
  // From the ball's face to the far corner, and a ball as large as the crumb.
  const double far = FarFromBall(crumb), ball = std::cbrt(VolumeOf(crumb.radius) * 3 / 4 / 3.14159265358979);
  EXPECT_NEAR(a.region.reach, dropped ? far + ball : 0, 1e-5 * (far + ball));
  EXPECT_EQ(now.components[0].vertices, VertexCount(Sphere({0, 0, 0}, 1, 4)));
  return dropped;
}

class SpecksOfSize : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Scaled, SpecksOfSize, testing::Values(1.0, 1e-6, 1e6));

TEST_P(SpecksOfSize, BodiesGoBelowTheCubeOfTheSpacing) {
  const double s = GetParam(), side = std::cbrt(VolumeOf(s));
  EXPECT_TRUE(IsDropped({s, s}, {just_more * side, 0, 0}));
  EXPECT_FALSE(IsDropped({s, s}, {just_less * side, 0, 0}));
}

TEST_P(SpecksOfSize, BodiesStayHoweverThinTheyAre) {
  const double s = GetParam(), side = std::cbrt(VolumeOf(s));
  EXPECT_FALSE(IsDropped({s, s}, {just_less * side, 100 * s, 100 * s}));
}

TEST_P(SpecksOfSize, VoidsGoBelowTheCubeOfTheSpacing) {
  const double s = GetParam(), side = std::cbrt(VolumeOf(s));
  EXPECT_TRUE(IsDropped({s, s, true}, {just_more * side, 0, 0}));
  EXPECT_FALSE(IsDropped({s, s, true}, {just_less * side, 0, 0}));
}

// Of a layer the thickness is two volumes for an area of both sides; of a ball a third of the radius.
TEST_P(SpecksOfSize, VoidsGoIfThinnerThanTheTriangles) {
  const double s = GetParam(), triangle = 6 * VolumeOf(s) / AreaOf(s);
  EXPECT_TRUE(IsDropped({s, s, true}, {0, just_more * triangle, 0}));
  EXPECT_FALSE(IsDropped({s, s, true}, {0, just_less * triangle, 0}));
}

TEST_P(SpecksOfSize, LongestEdgesDecideNothing) {
  EXPECT_FALSE(IsDropped({GetParam(), GetParam(), true}, {0, 0, plenty}));
}

// A pinched neck frees droplets.
TEST_P(SpecksOfSize, BodiesOfThePapersWayStay) {
  const double s = GetParam();
  EXPECT_FALSE(IsDropped({s, s, false, papers_attempt}, {100 * s, 100 * s, 0}));
  EXPECT_TRUE(IsDropped({s, s, true, papers_attempt}, {100 * s, 100 * s, 0}));
}

TEST_P(SpecksOfSize, NoneGoesBeyondTheLedger) {
  const double s = GetParam(), six_volumes = 6 * VolumeOf(s);
  for (bool is_void : {false, true}) {
    EXPECT_TRUE(IsDropped({s, s, is_void, cut_attempt, just_more * six_volumes}, {100 * s, 0, 0}));
    EXPECT_FALSE(IsDropped({s, s, is_void, cut_attempt, just_less * six_volumes}, {100 * s, 0, 0}));
  }
}

// The second speck is more than the first has left in the ledger.
TEST(Specks, ShareALedger) {
  OpenIsland island(Sphere({0, 0, 0}, 1, 4));
  for (double x : {5., 10.}) island.Make(Octahedron(1, {x, 0, 0}, false));
  tpa::Attempt a = island.Attempt(cut_attempt, 1.9 * 6 * VolumeOf(1));
  tpa::drop_specks(a, {100, 0, 0});
  EXPECT_EQ(TopologyOf(island.Now()).components.size(), 2u);
}

// Two tips over a ring.
Mesh Bipyramid(uint32_t ring) {
  Mesh m{{50, 0, 1, 50, 0, -1}, {}};
  for (uint32_t i = 0; i < ring; ++i) {
    const double turn = 2 * pi * i / ring;
    AddVertex(m, {50 + std::cos(turn), std::sin(turn), 0});
    AddTriangle(m, 0, 2 + i, 2 + (i + 1) % ring);
    AddTriangle(m, 1, 2 + (i + 1) % ring, 2 + i);
  }
  return m;
}

TEST(Specks, HaveNoMoreVerticesThanASpeckMay) {
  EXPECT_EQ(tpa::most_of_speck, 512u);
  for (uint32_t vertices : {511u, 512u, 513u}) {
    OpenIsland island(Sphere({0, 0, 0}, 1, 4));
    island.Make(Bipyramid(vertices - 2));
    tpa::Attempt a = island.Attempt(cut_attempt, plenty);
    tpa::drop_specks(a, {1000, 0, 0});
    EXPECT_EQ(TopologyOf(island.Now()).components.size(), vertices <= 512 ? 1u : 2u) << vertices;
  }
}

TEST(Specks, AreNoComponentsThatTheIslandHasNotMade) {
  OpenIsland island(
      Together({Sphere({0, 0, 0}, 1, 4), Octahedron(.1, {5, 0, 0}, false), Octahedron(.1, {9, 0, 0}, true)}));
  island.w.edit.journal.claims.owner = tpa::none;
  island.Make(Octahedron(.1, {20, 0, 0}, false));  // by another island
  island.w.edit.journal.claims.owner = 0;
  const std::vector<double> before = island.Now().positions;
  tpa::Attempt a = island.Attempt(cut_attempt, plenty);
  tpa::drop_specks(a, {100, 100, 100});
  EXPECT_EQ(island.Now().positions, before);
  EXPECT_EQ(a.region.volume(), 0);
}

// ---------------------------------------------------------------- sizes of the contacts

// Of an equilateral triangle the edge is 2 / sqrt(3), but for a tenth, of the root of twice the area.
TEST(SizesOfContacts, AreMeansOverTheFacesInContact) {
  for (double scale : {1.0, 1e-6, 1e6}) {
    const Mesh lower = Box({0, 0, 0}, {3, 1, 1}, 1), upper = Box({1, .25, .5}, {2, .75, 2}, 1);
    const Mesh idle = Together({Sphere({0, 0, 50}, 1, 3), Box({90, 0, 0}, {95, 7, 3}, 2)});
    const Mesh m = Mapped(Together({lower, upper, idle}), [&](const Point& p) { return Scaled(scale, p); });
    double spacing = 0, triangle = 0, longest = 0, faces = 0;
    for (const auto& [f, g] : AllMeetingPairs(m))
      for (uint32_t face : {f, g}) {
        const uint32_t* v = m.triangles.data() + 3 * face;
        const Point a = PositionOf(m, v[0]), b = PositionOf(m, v[1]), c = PositionOf(m, v[2]);
        const double sides[] = {Distance(a, b), Distance(b, c), Distance(c, a)};
        spacing += *std::min_element(sides, sides + 3);
        longest += *std::max_element(sides, sides + 3);
        triangle += std::sqrt(Length(Cross(Difference(b, a), Difference(c, a))));
        faces += 1;
      }
    ASSERT_GT(faces, 8);
    const OpenIsland island(m, m, tpa::Mode::adapt);
    const tpa::CutSizes sizes = tpa::sizes_of_contacts(island.w);
    EXPECT_NEAR(sizes.spacing, spacing / faces, 1e-12 * scale);
    EXPECT_NEAR(sizes.longest, longest / faces, 1e-12 * scale);
    EXPECT_NEAR(sizes.triangle, triangle / faces, 1e-12 * scale);
  }
}

TEST(SizesOfContacts, AreZeroWithoutContacts) {
  const OpenIsland island(Sphere({0, 0, 0}, 1, 3));
  const tpa::CutSizes sizes = tpa::sizes_of_contacts(island.w);
  EXPECT_EQ(sizes.spacing + sizes.longest + sizes.triangle, 0);
}

}  // namespace
}  // namespace specks_test
