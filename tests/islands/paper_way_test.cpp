// SPDX-License-Identifier: MIT
// Two balls join in the paper's way: one handle, a volume within the ledger, and neither more nor less than the ledger
// decides.
#include "islands/paper_way.h"

#include <cmath>

#include "oracle/region_columns.h"
#include "support/open_island.h"
#include "support/uneven_bodies.h"

namespace paper_way_test {
namespace {

using namespace support;

constexpr double plenty = 1e300;

struct Joined {
  tpa::Outcome outcome;
  tpa::RegionChange region;
  tpa_report report;
  Mesh moved, after;
};

Joined Join(int parts, double bound, const Mesh& idle = {}, double scale = 1) {
  const auto grown = [&](const Mesh& m) {
    return Mapped(Together({m, idle}), [&](const Point& p) { return Scaled(scale, p); });
  };
  const Mesh from = grown(Together({Sphere({0, 0, 0}, 1, parts), Sphere({.1, 0, 2.5}, 1, parts)}));
  const Mesh to = grown(Together({Sphere({0, 0, 0}, 1, parts), Sphere({.1, 0, 1.97}, 1, parts)}));
  OpenIsland island(from, to);
  tpa::Attempt a = island.Attempt(papers_attempt, bound);
  const tpa::Outcome outcome = tpa::go_papers_way(a);
  return {outcome, a.region, island.report, to, island.Now()};
}

TEST(PapersWay, JoinsTwoBallsByAHandle) {
  for (double scale : {1.0, 1e-6, 1e6}) {
    const Joined j = Join(10, plenty, Sphere({9, 0, 0}, 1, 3), scale);
    ASSERT_EQ(j.outcome, tpa::Outcome::clean);
    EXPECT_EQ(FaultOf(j.after), "");
    EXPECT_EQ(j.report.handles[0], 1u);
    EXPECT_EQ(j.report.caps, 0u);
    EXPECT_EQ(TopologyOf(j.after).Genera(), (std::vector<int64_t>{0, 0}));
  }
}

// By columns of rays.
TEST(PapersWay, TellsHowItChangesTheRegion) {
  for (int parts : {8, 12}) {
    const Joined j = Join(parts, plenty);
    ASSERT_EQ(j.outcome, tpa::Outcome::clean);
    const RegionDifference d = CompareChanges(j.moved, j.after, 4000, 1);
    EXPECT_NEAR(j.region.lost / 6, d.lost, 3 * d.error + .1 * d.lost);
    EXPECT_NEAR(j.region.gained / 6, d.gained, 3 * d.error + .1 * d.gained);
  }
}

TEST(PapersWay, IsBlockedBeyondTheLedger) {
  // Near the bound the finer grid measures.
  const double roughly = Join(10, plenty).region.volume(), volume = Join(10, roughly).region.volume();
  EXPECT_GT(volume, 0);
  EXPECT_NEAR(roughly, volume, .2 * volume);
  EXPECT_EQ(Join(10, volume * (1 + 1e-9)).outcome, tpa::Outcome::clean);
  EXPECT_EQ(Join(10, volume * (1 - 1e-9)).outcome, tpa::Outcome::blocked);
}

// All corners of a bar that goes through a box would go, and of a fine bar a small part.
TEST(PapersWay, IsBlockedWhereTheContactIsNotSmall) {
  for (int parts : {1, 12}) {
    const Mesh lower = Box({-1, -1, -1}, {1, 1, 1}, 12), upper = Box({-.5, -.5, .97}, {.5, .5, 4}, parts);
    OpenIsland island(Together({lower, Translated(upper, {0, 0, 1})}), Together({lower, upper}));
    tpa::Attempt a = island.Attempt(papers_attempt, plenty);
    EXPECT_EQ(tpa::go_papers_way(a), parts == 1 ? tpa::Outcome::blocked : tpa::Outcome::clean) << parts;
  }
}

TEST(PapersWay, IsTheSameBesideIdleBodies) {
  const Joined alone = Join(10, plenty);
  for (const Mesh& idle : {Sphere({0, 0, 1e6}, 1e5, 10), Sphere({1.5, 0, 1}, .1, 3), Sphere({-9, 0, 0}, 1, 30)}) {
    const Joined beside = Join(10, plenty, idle);
    EXPECT_EQ(beside.outcome, alone.outcome);
    EXPECT_EQ(beside.region.lost, alone.region.lost);
    EXPECT_EQ(beside.region.gained, alone.region.gained);
  }
}

// A ball meets a globe between its first two rings, so that the pole lies at the edge of the event, with a few new
// faces among many.
TEST(PapersWay, LeavesAHubInItsPlace) {
  const Mesh globe = Globe(40, 8);
  const double down = .6, out[3] = {std::sin(down), 0, std::cos(down)};
  const auto ball = [&](double far) { return Sphere({far * out[0], far * out[1], far * out[2]}, .2, 8); };
  OpenIsland island(Together({globe, ball(1.4)}), Together({globe, ball(1.14)}));
  tpa::Attempt a = island.Attempt(papers_attempt, plenty);
  ASSERT_EQ(tpa::go_papers_way(a), tpa::Outcome::clean);
  const tpa::Edit& e = island.w.edit;
  uint32_t pole = 0, faces = 0, made = 0, moved = 0;
  while (PositionOf(globe, pole) != Point{0, 0, 1}) ++pole;
  tpa::for_each_outgoing(e.mesh, pole, [&](uint32_t h) {
    ++faces;
    made += tpa::is_changed(e, tpa::face_of(h)) ? 1u : 0u;
  });
  EXPECT_GT(made, 0u);
  EXPECT_LT(2 * made, faces);
  EXPECT_EQ(tpa::old_position(e, pole), e.mesh.position[pole]);
  for (uint32_t v = 0; v < VertexCount(globe); ++v)
    moved += tpa::vertex_lives(e.mesh, v) && tpa::has_moved(e, v) ? 1u : 0u;
  EXPECT_GT(moved, 0u);
}

TEST(PapersWay, MeetsNothingToDoWithoutContacts) {
  OpenIsland island(Sphere({0, 0, 0}, 1, 4));
  tpa::Attempt a = island.Attempt(papers_attempt, 0);
  EXPECT_EQ(tpa::go_papers_way(a), tpa::Outcome::clean);
  EXPECT_EQ(island.Now().positions, Sphere({0, 0, 0}, 1, 4).positions);
}

}  // namespace
}  // namespace paper_way_test
