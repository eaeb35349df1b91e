// SPDX-License-Identifier: MIT
// The ledger of an island: one per cent of the components that meet, by volumes that the oracle measures; and the
// change of the region, by bodies and dents of known volume.
#include "islands/ledger.h"

#include <cmath>

#include "islands/rules.h"
#include "support/mesh_building.h"
#include "support/open_island.h"

namespace ledger_test {
namespace {

using namespace support;

Mesh InsideOut(Mesh m) {
  for (size_t f = 0; f < TriangleCount(m); ++f) std::swap(m.triangles[3 * f], m.triangles[3 * f + 1]);
  return m;
}
Mesh Scaled(const Mesh& m, double by) {
  return Mapped(m, [&](const Point& p) { return support::Scaled(by, p); });
}

// ---------------------------------------------------------------- the bound

double BoundOf(const Mesh& from, const Mesh& to) {
  const OpenIsland island(from, to);
  EXPECT_FALSE(island.w.detection.pairs.empty());
  return tpa::open_ledger(island.t).bound;
}

// Before the step, the right ball is two from the left one.
const Mesh left = Sphere({0, 0, 0}, 1, 4), right = Sphere({4, 0, 0}, 1.5, 5), met = Sphere({2.3, 0, 0}, 1.5, 5);

TEST(Bound, IsOnePerCentOfTheComponentsThatMeet) {
  EXPECT_EQ(tpa::ledger_share, 0.01);
  for (double scale : {1.0, 1e-6, 1e6}) {
    const double wanted = 0.01 * 6 * (TopologyOf(left).Volume() + TopologyOf(right).Volume()) * std::pow(scale, 3);
    EXPECT_NEAR(BoundOf(Scaled(Together({left, right}), scale), Scaled(Together({left, met}), scale)), wanted,
                1e-9 * wanted);
  }
}

TEST(Bound, DependsOnNoOtherComponent) {
  const double alone = BoundOf(Together({left, right}), Together({left, met}));
  const Mesh near = Sphere({0, 0, 2.2}, 1, 5), huge = Sphere({0, 0, 9000}, 1000, 5), fine = Sphere({0, 0, -5}, 1, 30);
  for (const Mesh& idle : {near, huge, fine, InsideOut(huge)}) {
    EXPECT_EQ(BoundOf(Together({left, right, idle}), Together({left, met, idle})), alone);
    EXPECT_NEAR(BoundOf(Together({idle, left, right}), Together({idle, left, met})), alone, 1e-12 * alone);
  }
}

TEST(Bound, IsThatOfTheVolumesBeforeTheStep) {
  const double wanted = 0.01 * 6 * TopologyOf(left).Volume();
  const Mesh crumpled = Mapped(Scaled(left, .6), [](const Point& p) { return p[0] > .55 ? Point{-1, p[1], p[2]} : p; });
  EXPECT_NEAR(BoundOf(left, crumpled), wanted, 1e-9 * wanted);
}

// A void counts as much as a body of its size.
TEST(Bound, CountsVoidsByTheirOwnVolume) {
  const Mesh gap = InsideOut(Sphere({0, 0, 0}, .5, 3)), moved = Translated(gap, {.6, 0, 0});
  const double wanted = 0.01 * 6 * (TopologyOf(left).Volume() - TopologyOf(gap).Volume());
  EXPECT_LT(TopologyOf(gap).Volume(), 0);
  EXPECT_NEAR(BoundOf(Together({left, gap}), Together({left, moved})), wanted, 1e-9 * wanted);
}

TEST(Bound, LeavesNoTraceInTheComponents) {
  const OpenIsland island(Together({left, right}), Together({left, met}));
  const double first = tpa::open_ledger(island.t).bound;
  EXPECT_EQ(tpa::open_ledger(island.t).bound, first);
  for (const tpa::Component& c : island.w.before.list) EXPECT_FALSE(c.is_followed);
}

// ---------------------------------------------------------------- the change

// A point in a line of the grid.
constexpr double one_line = 1. / 24 / 24;

struct Change {
  double lost, gained;
};
// Told volumes are larger than counted ones by the deviation of as many points at random.
void ExpectVolume(double told, double volume, double share, double of_grid) {
  const double deviation = std::sqrt(volume * of_grid / (24 * 24 * 24));
  EXPECT_GE(told, volume * (1 - share));
  EXPECT_LE(told, (volume + deviation) * (1 + share));
}
// `share`: of the volumes, that counts may be off. `of_grid`: the volume of the box round all changed faces.
void ExpectChange(OpenIsland& island, const Change& volumes, double share, double of_grid) {
  const double all = volumes.lost + volumes.gained;
  const tpa::RegionChange c = tpa::measure_change(island.t, all > 0 ? 6 * all : of_grid);
  ExpectVolume(c.lost / 6, volumes.lost, share, of_grid);
  ExpectVolume(c.gained / 6, volumes.gained, share, of_grid);
}

void MoveVertex(OpenIsland& island, uint32_t v, const tpa::Vec3& to) {
  const tpa::Mesh& m = island.w.edit.mesh;
  tpa::set_position(island.w.edit, v, to);
  tpa::for_each_outgoing(m, v, [&](uint32_t h) { tpa::insert(island.w.near_faces, m, tpa::face_of(h)); });
}

// The 8 vertices of a box of n = 1, and so on, after those of other parts.
std::vector<uint32_t> Numbers(uint32_t first, const Mesh& m) {
  std::vector<uint32_t> numbers;
  for (uint32_t v = 0; v < VertexCount(m); ++v) numbers.push_back(first + v);
  return numbers;
}

// A box fills its grid.
TEST(Change, OfABoxThatGoesIsItsVolume) {
  for (double scale : {1.0, 1e-6, 1e6})
    for (double far : {0., 1e6}) {
      const Mesh idle = Sphere({0, 0, 5}, 1, 3), box = Box({3, 1, 2}, {4, 3, 5}, 1);
      OpenIsland island(Translated(Scaled(Together({idle, box}), scale), {far * scale, 0, 0}));
      island.Remove(Numbers(VertexCount(idle), box));
      ExpectChange(island, {6 * std::pow(scale, 3), 0}, one_line, 6 * std::pow(scale, 3));
    }
}

TEST(Change, OfABallThatGoesIsItsVolumeWithinAPerCent) {
  const Mesh idle = Sphere({0, 0, 5}, 1, 3), ball = Sphere({9, 0, 0}, 2, 8);
  OpenIsland island(Together({idle, ball}));
  island.Remove(Numbers(VertexCount(idle), ball));
  ExpectChange(island, {TopologyOf(ball).Volume(), 0}, .01, 64);
}

TEST(Change, OfAVoidThatGoesIsAGain) {
  const Mesh body = Box({0, 0, 0}, {9, 9, 9}, 2), gap = InsideOut(Box({3, 1, 2}, {4, 3, 5}, 1));
  OpenIsland island(Together({body, gap}));
  island.Remove(Numbers(VertexCount(body), gap));
  ExpectChange(island, {0, 6}, one_line, 6);
}

TEST(Change, OfABodyInsideAnotherIsNone) {
  const Mesh body = Box({0, 0, 0}, {9, 9, 9}, 2), inner = Box({3, 1, 2}, {4, 3, 5}, 1);
  OpenIsland island(Together({body, inner}));
  island.Remove(Numbers(VertexCount(body), inner));
  ExpectChange(island, {0, 0}, 0, 6);
}

// Lines of the grid are wholly inside the other body, or cross its surface.
TEST(Change, OfABodyThatOverlapsAnotherIsItsOwnPart) {
  for (size_t axis = 0; axis < 3; ++axis) {
    Point low{3, 3, 3}, high{5, 5, 5};
    low[axis] = 8, high[axis] = 10;
    const Mesh body = Box({0, 0, 0}, {9, 9, 9}, 1), other = Box(low, high, 1);
    OpenIsland island(Together({body, other}));
    island.Remove(Numbers(VertexCount(body), other));
    ExpectChange(island, {4, 0}, 2. / 24, 8);
  }
}

// The lens that both balls have in common is no loss, whatever their direction.
TEST(Change, OfBallsThatJoinIsTheSameInAllDirections) {
  const Mesh ball = Sphere({0, 0, 0}, 1, 10), from = Sphere({.07, .03, 2.3}, 1, 10),
             to = Sphere({.07, .03, 1.84}, 1, 10);
  const double volume = TopologyOf(Together({ball, from})).Volume();
  double most = 0, least = volume;
  for (int rotation = 0; rotation < 24; ++rotation) {
    const Mesh m = QuarterTurned(Together({ball, from}), rotation),
               moved = QuarterTurned(Together({ball, to}), rotation);
    const Arena arena(ConfigFor(m), m);
    ASSERT_EQ(MoveAll(*arena, moved.positions), TPA_OK);
    auto report = Sized<tpa_report>();
    ASSERT_EQ(tpa_step(*arena, nullptr, &report, nullptr), TPA_OK);
    EXPECT_EQ(report.handles[0], 1u) << rotation;
    most = std::max(most, report.region_lost);
    least = std::min(least, report.region_lost);
  }
  EXPECT_LT(most - least, .0025 * volume);
}

TEST(Change, OfABodyThatIsMadeIsAGain) {
  OpenIsland island(Sphere({0, 0, 9}, 1, 3));
  island.Make(Box({3, 1, 2}, {4, 3, 5}, 1));
  ExpectChange(island, {0, 6}, one_line, 6);
}

TEST(Change, OfLossesAndGainsDoesNotCancel) {
  const Mesh idle = Sphere({0, 0, 20}, 1, 3), box = Box({3, 1, 2}, {4, 3, 5}, 1);
  OpenIsland island(Together({idle, box}));
  island.Remove(Numbers(VertexCount(idle), box));
  island.Make(Box({4, 1, 2}, {5, 3, 5}, 1));
  ExpectChange(island, {6, 6}, .05, 12);
}

// A tip of a box with sides of four faces moves in or out: a pyramid.
TEST(Change, OfADentIsItsVolumeAndTheMoveOfTheStepIsNone) {
  const Mesh box = Box({0, 0, 0}, {2, 2, 2}, 2), moved = Translated(box, {7, 0, 0});
  uint32_t middle = 0;
  for (uint32_t v = 0; v < VertexCount(moved); ++v)
    if (PositionOf(moved, v) == Point{8, 1, 2}) middle = v;
  for (double by : {-.75, .75}) {
    OpenIsland island(box, moved);
    ExpectChange(island, {0, 0}, 0, 6);
    MoveVertex(island, middle, {8, 1, 2 + by});
    const double pyramid = 3 * .75 / 3;  // its base: the six triangles at the tip, half of a face each
    ExpectChange(island, by < 0 ? Change{pyramid, 0} : Change{0, pyramid}, .02, 2 * 2 * .75);
    // The farthest corner at the tip from a face beside it, and no deeper than a ball of the volume.
    island.t.met.faces.add(tpa::face_of(island.w.edit.mesh.vertex_edge[middle]));
    const tpa::RegionChange c = tpa::measure_change(island.t, 6 * pyramid);
    const double ball = std::cbrt(c.volume() / (8 * 3.14159265358979));
    EXPECT_NEAR(c.reach, std::max(1., std::sqrt(2.)) + ball, 1e-5);
  }
}

TEST(Change, NearTheBoundIsCountedOnAFinerGrid) {
  const Mesh idle = Sphere({0, 0, 20}, 1, 3), ball = Sphere({.3, .1, .2}, 1, 6);
  const double volume = 6 * TopologyOf(ball).Volume();
  const auto off = [&](double bound) {
    OpenIsland island(Together({idle, ball}));
    island.Remove(Numbers(VertexCount(idle), ball));
    return std::fabs(tpa::measure_change(island.t, bound).lost - volume);
  };
  const double near = off(volume);
  EXPECT_LT(near, .015 * volume);
  for (double share : {.98, 1.04}) EXPECT_EQ(off(share * volume), near) << share;
  for (double share : {.1, .5, .8, 1.2, 2.}) {
    EXPECT_EQ(off(share * volume), off(.2 * volume)) << share;
    EXPECT_NE(off(share * volume), near) << share;
    EXPECT_LT(off(share * volume), .05 * volume) << share;
  }
}

// A diagonal needle lies between the points.
TEST(Change, ThatHidesBetweenPointsIsMoreThanTheBound) {
  for (const double thick : {1e-2, 1e-4, 1e-9}) {
    const Mesh idle = Sphere({0, 0, 20}, 1, 3);
    const Mesh needle = Mapped(Box({0, 0, 0}, {9, 1, 1}, 1), [&](const Point& p) {
      return Point{p[0] + .3 * thick * p[1], p[0] + thick * p[1], p[0] + thick * p[2]};
    });
    OpenIsland island(Together({idle, needle}));
    island.Remove(Numbers(VertexCount(idle), needle));
    const double bound = 6 * .01 * TopologyOf(needle).Volume();
    EXPECT_GT(tpa::measure_change(island.t, bound).volume(), bound) << thick;
  }
}

TEST(Change, IsTheSameBesideIdleBodies) {
  const Mesh box = Box({3, 1, 2}, {4, 3, 5}, 1), dented = Sphere({9, 0, 0}, 2, 5);
  const auto change = [&](const Mesh& idle) {
    OpenIsland island(Together({box, dented, idle}));
    island.Remove(Numbers(0, box));
    MoveVertex(island, 8, {9.1, .2, .3});
    island.t.met.faces.add(0);
    return tpa::measure_change(island.t, 1);
  };
  const tpa::RegionChange alone = change(Sphere({1, 1, 1e5}, 1, 3));
  for (const Mesh& idle :
       {Sphere({1, 1, -1e5}, 1e3, 3), Sphere({1, 1, 1e5}, 1, 20), Box({-9, -9, -99}, {9, 9, -98}, 3)}) {
    const tpa::RegionChange beside = change(idle);
    EXPECT_EQ(alone.lost, beside.lost);
    EXPECT_EQ(alone.gained, beside.gained);
    EXPECT_EQ(alone.reach, beside.reach);
    EXPECT_GT(beside.reach, 5);
  }
}

}  // namespace
}  // namespace ledger_test
