// SPDX-License-Identifier: MIT
// Resolving tangled meshes (P2): the result is the boundary of the region of winding number >= 1.
#include <algorithm>
#include <cstdlib>
#include <initializer_list>

#include "support/resolve_trial.h"
#include "support/share.h"
#include "support/step_scenes.h"
#include "support/tangle_shapes.h"

namespace resolve_test {
namespace {

using namespace support;

// ---------------------------------------------------------------- the oracle

struct Solid {
  const char* name;
  Mesh mesh;
  Betti betti;
  double volume;
};

TEST(WindingGrid, KnowsSolidsOfKnownTopologyAndVolume) {
  const Mesh torus = Torus({0.1, 0.2, 0.3}, 2, 0.7, 96, 48), ball = Sphere({0.03, 0.02, 0.01}, 1, 24);
  const Solid solids[] = {
      {"ball", ball, {1, 0, 0}, 4 * pi / 3},
      {"torus", torus, {1, 1, 0}, 2 * pi * pi * 2 * 0.49},
      {"two balls", Together({ball, Translated(ball, {2.5, 0, 0})}), {2, 0, 0}, 8 * pi / 3},
      {"balls that overlap", Together({ball, Translated(ball, {1, 0, 0})}), {1, 0, 0}, 4 * pi / 3 + 11 * pi / 12},
      {"ball in ball", Together({ball, Sphere({0.1, 0.1, 0.1}, 0.4, 12)}), {1, 0, 0}, 4 * pi / 3},
      {"shell", Together({ball, Reversed(Sphere({0.1, 0.1, 0.1}, 0.4, 12))}), {1, 0, 1}, 4 * pi / 3 * (1 - 0.064)},
      {"ring through ring",
       Together({torus, Translated(QuarterTurned(torus, 1), {2, 0, 0})}),
       {2, 2, 0},
       4 * pi * pi * 2 * 0.49},
      {"inside out", Reversed(ball), {0, 0, 0}, 0},
  };
  for (const Solid& s : solids) {
    const Lattice lattice = LatticeRound(s.mesh, 120);
    const Cells cells = AtLeastOne(WindingNumbers(s.mesh, lattice));
    EXPECT_EQ(Text(BettiOf(cells, lattice)), Text(s.betti)) << s.name;
    EXPECT_NEAR(VolumeOf(cells, lattice), s.volume, 0.01 * s.volume) << s.name;
    EXPECT_EQ(VolumeOfDifference(cells, cells, lattice), 0) << s.name;
  }
}

TEST(WindingGrid, DropsSpecksOnly) {
  const Mesh ball = Sphere({0.03, 0.02, 0.01}, 1, 24), mote = Sphere({}, 0.1, 8);
  const Mesh m = Together({ball, Reversed(mote), Translated(mote, {1.3, 0, 0})});
  const Lattice lattice = LatticeRound(m, 120);
  Cells cells = AtLeastOne(WindingNumbers(m, lattice));
  DropSpecks(0.003, lattice, cells);
  EXPECT_EQ(BettiOf(cells, lattice), (Betti{2, 0, 1}));
  DropSpecks(0.005, lattice, cells);
  EXPECT_EQ(BettiOf(cells, lattice), (Betti{1, 0, 0}));
}

// Lines through vertices and edges: every coordinate of the mesh is the middle of a cell.
TEST(WindingGrid, LinesThroughEdgesAndVerticesCountOnce) {
  const Mesh box = Box({2.5, 2.5, 2.5}, {5.5, 6.5, 7.5}, 1);
  const Lattice lattice{{0, 0, 0}, 1, {9, 9, 10}};
  const std::vector<int16_t> winding = WindingNumbers(box, lattice);
  EXPECT_EQ(std::count(winding.begin(), winding.end(), 0), static_cast<std::ptrdiff_t>(winding.size() - 3 * 4 * 5));
  EXPECT_EQ(std::count(winding.begin(), winding.end(), 1), 3 * 4 * 5);
}

TEST(WindingGrid, NearnessIsMeasuredToTheTriangle) {
  const Mesh box = Box({0, 0, 0}, {10, 10, 10}, 1);
  const Lattice lattice = LatticeRound(box, 50, 0.5);
  Cells cells(lattice.Cells());
  std::vector<uint32_t> all(TriangleCount(box));
  for (uint32_t f = 0; f < all.size(); ++f) all[f] = f;
  AddNear(box, all, 0.5, lattice, cells);
  EXPECT_EQ(BettiOf(cells, lattice), (Betti{1, 0, 1}));
  // Half inside, half outside, where edges and corners are rounded: Steiner's formula for a cube, the inner
  // part exact.
  const double outer = 6 * 100 * 0.5 + 12 * 10 * 0.25 * 3.14159265 * 0.25 + 4.18879 * 0.125, inner = 1000 - 729;
  EXPECT_NEAR(VolumeOf(cells, lattice), outer + inner, 0.03 * (outer + inner));
}

// Two boxes joined by a bar come apart where the bar is marked; unmarked cells stay.
TEST(WindingGrid, ErosionTakesWhatIsNearTheOutside) {
  const Mesh boxes =
      Together({Box({0, 0, 0}, {4, 4, 4}, 1), Box({8, 0, 0}, {12, 4, 4}, 1), Box({3, 1.7, 1.7}, {9, 2.3, 2.3}, 1)});
  const Lattice lattice{{-1.05, -1.05, -1.05}, 0.1, {141, 61, 61}};
  const Cells region = AtLeastOne(WindingNumbers(boxes, lattice));
  Cells all(lattice.Cells(), 1), bar(lattice.Cells());
  for (int k = 0; k < lattice.count[2]; ++k)
    for (int j = 0; j < lattice.count[1]; ++j)
      for (int i = 0; i < lattice.count[0]; ++i) {
        const double x = lattice.Middle(i, j, k)[0];
        bar[lattice.At(i, j, k)] = x > 4.1 && x < 7.9 ? 1 : 0;
      }
  Cells eroded = region;
  Erode(0.2, all, lattice, eroded);
  EXPECT_EQ(BettiOf(eroded, lattice), (Betti{1, 0, 0}));
  eroded = region;
  Erode(0.5, all, lattice, eroded);
  EXPECT_EQ(BettiOf(eroded, lattice), (Betti{2, 0, 0}));
  EXPECT_NEAR(VolumeOf(eroded, lattice), 2 * 27, 0.1 * 54);
  eroded = region;
  Erode(0.5, bar, lattice, eroded);
  EXPECT_EQ(BettiOf(eroded, lattice), (Betti{2, 0, 0}));
  EXPECT_NEAR(VolumeOf(region, lattice) - VolumeOf(eroded, lattice), 3.8 * 0.36, 0.1);
}

// ---------------------------------------------------------------- families

// A tenth of each family, at most four meshes, or a share of these; with TOPOADAPT_ALL_TANGLES set, all meshes.
uint32_t CountOf(const Family& family) {
  if (std::getenv("TOPOADAPT_ALL_TANGLES") != nullptr) return family.count;
  return Share(std::clamp(family.count / 10, 1u, 4u));
}

void ExpectRight(const Family& family, const Tangle& tangle, const ResolveTrial& t, uint64_t seed) {
  const std::string name = std::string(family.name) + "-" + std::to_string(seed);
  SCOPED_TRACE(name);
  const MeshOnFailure tangled(name, tangle.mesh), resolved(name + "-resolved", t.result);
  ASSERT_EQ(t.status, TPA_OK) << Text(t.issue);
  ASSERT_EQ(t.defect, "");
  EXPECT_EQ(t.meeting, 0u);
  EXPECT_EQ(t.report.unresolved, t.meeting);
  EXPECT_TRUE(t.winding_is_plain);
  EXPECT_LE(t.volume_error, family.volume_tolerance);
  EXPECT_NE(t.topology, Verdict::wrong) << t.found << " instead of " << t.expected;
}

class Tangles : public testing::TestWithParam<Family> {};

TEST_P(Tangles, ComeOutCleanAndAsTheyShould) {
  const Family& family = GetParam();
  uint32_t judged = 0;
  for (uint64_t seed = 1; seed <= CountOf(family); ++seed) {
    const Tangle tangle = MakeTangle(family, seed);
    if (tangle.mesh.triangles.empty()) GTEST_SKIP() << "no real meshes here";
    const ResolveTrial t = TryToResolve(family, tangle);
    ExpectRight(family, tangle, t, seed);
    judged += t.topology != Verdict::not_judged ? 1u : 0u;
  }
  // A family without a single clear answer proves nothing.
  EXPECT_TRUE(family.coarse || judged > 0 || IsQuick());
}

std::string NameOf(const testing::TestParamInfo<Family>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(All, Tangles, testing::ValuesIn(TangleFamilies()), NameOf);

// ---------------------------------------------------------------- what stays, what is told

TEST(Resolve, VerticesFarFromContactsKeepTheirBits) {
  for (const char* name : {"sphere-pair", "tube-through-tube", "knot", "cow", "self-intersect", "two-spheres"}) {
    const Mesh before = MakeTangle(TangleFamily(name), 1).mesh;
    if (before.triangles.empty()) continue;  // no real meshes here
    const Arena arena(GenerousConfig(before), before);
    ASSERT_EQ(tpa_adapt(*arena, nullptr, nullptr, nullptr), TPA_OK) << name;
    const FarVertices far = FarFromContacts(before, MeshOf(*arena), 5, 80);
    EXPECT_GT(far.all, 20u) << name;
    EXPECT_EQ(far.lost, 0u) << name << ", of " << far.all;
  }
}

// Real meshes, judged by more than volume: the space where the result differs from the union.
TEST(Resolve, RealMeshesKeepTheirSpace) {
  for (const char* name : {"cow", "self-intersect"}) {
    const Family& family = TangleFamily(name);
    const Tangle tangle = MakeTangle(family, 1);
    if (tangle.mesh.triangles.empty()) GTEST_SKIP() << "no real meshes here";
    EXPECT_LE(TryToResolve(family, tangle).difference, 0.01) << name;
  }
}

// The band removed along a seam is some quarter of an edge wide. With all vertices of faces in contact, the band was
// six times as wide, and the space differing from the union up to .025.
TEST(Resolve, WhatIsSeenStays) {
  for (uint64_t seed = 1; seed <= Share(10u); ++seed) {
    const Family& family = TangleFamily("sphere-pair");
    EXPECT_LE(TryToResolve(family, MakeTangle(family, seed)).difference, 0.006) << "seed " << seed;
  }
}

void ExpectSeedsRight(const char* name, const std::vector<uint64_t>& seeds) {
  const Family& family = TangleFamily(name);
  for (size_t i = 0; i < seeds.size(); i += Stride()) {
    const Tangle tangle = MakeTangle(family, seeds[i]);
    if (tangle.mesh.triangles.empty()) GTEST_SKIP() << "no real meshes here";
    ExpectRight(family, tangle, TryToResolve(family, tangle), seeds[i]);
  }
}

// Little is left where all vertices of faces in contact go: a quarter of the volume and more went.
TEST(Resolve, CubesAboutOneCentreKeepTheirVolume) { ExpectSeedsRight("five-copies", {5, 6, 7, 10}); }
// The surfaces between their loops have handles themselves, round tunnels left in between.
TEST(Resolve, ToriAboutOneCentreKeepTheirTunnels) { ExpectSeedsRight("five-copies", {16, 18}); }
TEST(Resolve, CowsAboutOneCentreKeepTheirVolume) { ExpectSeedsRight("five-cows", {6}); }

TEST(Resolve, TheNumberingDoesNotMatter) {
  for (uint64_t seed = 1; seed <= Share(10u); ++seed) {
    const Tangle tangle = MakeTangle(TangleFamily("sphere-pair"), seed);
    Random random(seed);
    for (int i = 0; i < 3; ++i) {
      const ResolveTrial t =
          TryToResolve(TangleFamily("sphere-pair"), {Renumbered(tangle.mesh, random), tangle.genera});
      EXPECT_TRUE(t.Clean() && t.topology == Verdict::right) << "seed " << seed << ", " << t.found;
    }
  }
}

// One pass is too few where many faces lie upon each other but for rounding: contacts are counted, and the mesh stays
// as it was.
TEST(Resolve, WhatTheLimitsLeaveIsCounted) {
  size_t left = 0;
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    Mesh before = Sphere({}, 1, 8);
    before.positions = CoincidingTargets(before, random);
    tpa_config config = GenerousConfig(before);
    config.max_passes = 1;
    const Arena arena(config, before);
    auto report = Sized<tpa_report>();
    ASSERT_EQ(tpa_adapt(*arena, nullptr, &report, nullptr), TPA_OK);
    const Mesh after = MeshOf(*arena);
    EXPECT_EQ(TopologyOf(after).defect, "");
    auto contacts = Sized<tpa_contacts>();
    ASSERT_EQ(tpa_detect(*arena, nullptr, &contacts, nullptr), TPA_OK);
    EXPECT_EQ(report.unresolved, contacts.count);
    if (report.unresolved == 0) continue;
    left += report.unresolved;
    EXPECT_EQ(after.positions, before.positions);
    EXPECT_EQ(after.triangles, before.triangles);
    EXPECT_EQ(report.region_lost + report.region_gained, 0);
  }
  EXPECT_GT(left, 0u) << "the limits are too wide to try anything";
}

TEST(Resolve, ALimitThatIsReachedChangesNothing) {
  const Mesh before = MakeTangle(TangleFamily("sphere-pair"), 1).mesh;
  const auto refuses = [&](auto set, int32_t limit) {
    tpa_config config = GenerousConfig(before);
    set(config);
    const Arena arena(config, before);
    const Observed was = Observe(*arena);
    tpa_issue issue;
    EXPECT_EQ(tpa_adapt(*arena, nullptr, nullptr, &issue), TPA_E_LIMIT);
    EXPECT_EQ(issue.limit, limit);
    EXPECT_GT(issue.needed, issue.available);
    EXPECT_EQ(Observe(*arena), was);
  };
  refuses([](tpa_config& c) { c.max_contacts = 8; }, TPA_LIMIT_CONTACTS);
  refuses([](tpa_config& c) { c.max_pieces = 8; }, TPA_LIMIT_PIECES);
}

}  // namespace
}  // namespace resolve_test
