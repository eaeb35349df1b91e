// SPDX-License-Identifier: MIT
// Boxes that overlap, touch or nearly touch are cut: the union by volumes written down by hand.
#include "islands/close_and_cut.h"

#include <cmath>

#include "support/open_island.h"

namespace close_and_cut_test {
namespace {

using namespace support;

constexpr double plenty = 1e300;

struct Cut {
  tpa::Outcome outcome;
  Mesh after;
  tpa::RegionChange region;
  tpa_report report;
};

Cut CutAll(const Mesh& from, const Mesh& to, tpa::Mode mode, double bound, uint32_t max_passes = 8) {
  OpenIsland island(from, to, mode);
  island.w.context.config.max_passes = max_passes;
  tpa::Attempt a = island.Attempt(mode == tpa::Mode::step ? cut_attempt : 0, bound);
  const tpa::Outcome outcome = tpa::close_and_cut(a);
  return {outcome, island.Now(), a.region, island.report};
}
Cut Adapt(const Mesh& m, uint32_t max_passes = 8) { return CutAll(m, m, tpa::Mode::adapt, 0, max_passes); }

void ExpectUnion(const Cut& cut, double volume, size_t bodies, double tolerance) {
  EXPECT_EQ(cut.outcome, tpa::Outcome::clean);
  EXPECT_EQ(FaultOf(cut.after), "");
  const Topology t = TopologyOf(cut.after);
  EXPECT_NEAR(t.Volume(), volume, tolerance);
  EXPECT_EQ(t.components.size(), bodies);
  EXPECT_EQ(t.Genus(), 0);
}

TEST(ExactCut, OfTwoBoxesIsTheirUnion) {
  for (double scale : {1.0, 1e-6, 1e6})
    for (double far : {0., 1e6}) {
      const Mesh m =
          Mapped(Together({Box({0, 0, 0}, {2, 2, 2}, 1), Box({1, .5, .25}, {4, 1.5, 1.25}, 2)}), [&](const Point& p) {
            return Scaled(scale, Sum(p, {far, 0, 0}));
          });
      // Of the second box of 3, a third lies in the first.
      ExpectUnion(Adapt(m), (8 + 2) * std::pow(scale, 3), 1, 1e-9 * (1 + far) * std::pow(scale, 3));
    }
}

TEST(ExactCut, OfBoxesWithACommonFaceIsOneBox) {
  ExpectUnion(Adapt(Together({Box({0, 0, 0}, {1, 1, 1}, 1), Box({1, 0, 0}, {2, 1, 1}, 1)})), 2, 1, 1e-12);
}

TEST(ExactCut, OfABoxInAnotherIsNone) {
  // Free of contacts, both stay.
  const Mesh nested = Together({Box({0, 0, 0}, {3, 3, 3}, 1), Box({1, 1, 1}, {2, 2, 2}, 1)});
  EXPECT_EQ(Adapt(nested).after.positions, nested.positions);
}

// But for a rounding, their faces would cross in nothing but rounding errors.
TEST(ExactCut, OfBoxesThatNearlyTouchJoinsThem) {
  const double turn = .37, c = std::cos(turn), s = std::sin(turn);
  const Mesh m =
      Mapped(Together({Box({0, 0, 0}, {1, 1, 1}, 2), Box({1, .25, .25}, {2, .75, .75}, 3)}), [&](const Point& p) {
        const Point q{c * p[0] - s * p[1], s * p[0] + c * p[1], p[2]};
        return Point{q[0], c * q[1] - s * q[2], s * q[1] + c * q[2]};
      });
  ASSERT_FALSE(AllMeetingPairs(m).empty());
  ExpectUnion(Adapt(m), 1.25, 1, 1e-8);
}

TEST(ExactCut, IsBlockedWithoutPasses) {
  const Mesh m = Together({Box({0, 0, 0}, {2, 2, 2}, 1), Box({1, .5, .25}, {4, 1.5, 1.25}, 2)});
  EXPECT_EQ(Adapt(m, 0).outcome, tpa::Outcome::blocked);
  EXPECT_EQ(Adapt(m, 0).after.positions, m.positions);
  const Cut once = Adapt(m, 1);
  EXPECT_EQ(once.outcome, tpa::Outcome::clean);
  EXPECT_EQ(once.report.passes, 1u);
}

// ---------------------------------------------------------------- in a step

const Mesh left = Sphere({0, 0, 0}, 1, 6), apart = Sphere({.1, .05, 2.3}, 1, 7), met = Sphere({.1, .05, 1.8}, 1, 7);

TEST(CutOfAStep, TidiesWithinTheLedger) {
  const Mesh from = Together({left, apart}), to = Together({left, met});
  const Cut all = CutAll(from, to, tpa::Mode::step, plenty);
  ASSERT_EQ(all.outcome, tpa::Outcome::clean);
  EXPECT_EQ(FaultOf(all.after), "");
  EXPECT_EQ(TopologyOf(all.after).Genera(), (std::vector<int64_t>{0}));
  const double volume = all.region.volume();
  EXPECT_GT(volume, 0);
  // Less is tidied, but never more than the ledger has.
  for (double share : {1 + 1e-9, 1 - 1e-9, .5, .1}) {
    const Cut less = CutAll(from, to, tpa::Mode::step, share * volume);
    EXPECT_EQ(less.outcome, tpa::Outcome::clean);
    EXPECT_LE(less.region.volume(), share * volume);
    EXPECT_GE(VertexCount(less.after), VertexCount(all.after));
  }
  // Seams alone change nothing: the exact cut is tpa_adapt's.
  EXPECT_NEAR(TopologyOf(CutAll(from, to, tpa::Mode::step, .01 * volume).after).Volume(),
              TopologyOf(Adapt(to).after).Volume(), .01 * volume);
}

// To be separated, surfaces that nearly lie upon each other change the region: more than an empty ledger has.
TEST(CutOfAStep, IsBlockedWhereTheLedgerIsOverdrawn) {
  const Mesh lower = Box({0, 0, 0}, {1, 1, 1}, 2);
  const auto upper = [](double height) {
    return Mapped(Box({0, 0, 1}, {1, 1, 2}, 2), [&](const Point& p) {
      return Point{p[0], p[1], p[2] + height + (p[0] - .5) * 0x1p-48};
    });
  };
  const Mesh from = Together({lower, upper(.5)}), to = Together({lower, upper(0)});
  const Cut all = CutAll(from, to, tpa::Mode::step, plenty);
  ASSERT_EQ(all.outcome, tpa::Outcome::clean);
  ASSERT_GT(all.region.volume(), 0);
  EXPECT_EQ(CutAll(from, to, tpa::Mode::step, 0).outcome, tpa::Outcome::blocked);
}

TEST(CutOfAStep, IsTheSameBesideIdleBodies) {
  const Cut alone = CutAll(Together({left, apart}), Together({left, met}), tpa::Mode::step, 1);
  for (const Mesh& idle : {Sphere({0, 0, 1e6}, 1e5, 10), Sphere({1.5, 0, 1}, .1, 3), Sphere({-9, 0, 0}, 1, 30)}) {
    const Cut beside = CutAll(Together({left, apart, idle}), Together({left, met, idle}), tpa::Mode::step, 1);
    EXPECT_EQ(beside.outcome, alone.outcome);
    EXPECT_EQ(beside.region.lost, alone.region.lost);
    EXPECT_EQ(beside.region.gained, alone.region.gained);
    EXPECT_EQ(VertexCount(beside.after), VertexCount(alone.after) + VertexCount(idle));
  }
}

}  // namespace
}  // namespace close_and_cut_test
