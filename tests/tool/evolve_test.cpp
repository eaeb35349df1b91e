// SPDX-License-Identifier: MIT
// Scenes played to their ends. A failure names the command to repeat it. `evolve_figures` plays more of each kind.
#include "oracle/ball_union.h"
#include "support/evolve_family.h"
#include "support/share.h"
#include "support/support.h"
#include "tool/scenes/scene.h"
#include "tool/scenes/sphere.h"

namespace evolve_test {
namespace {

using namespace support;

void ExpectFamily(const Play& play, uint32_t seeds, Pose pose = Pose::as_is) {
  const FamilyResult r = JudgeFamily(play, Share(seeds), pose);
  std::printf("%s: of %u %u right, %u clean, %u near critical, %.1f s\n", play.kind.c_str(), r.played, r.right, r.clean,
              r.near_critical, r.seconds);
  for (const FamilyResult::Failure& f : r.failures) ADD_FAILURE() << f.command << ": " << f.fault;
  EXPECT_GT(r.right + r.clean, 0u) << play.kind << ": all are near critical";
}

tool::Scene SceneOf(const std::string& kind, uint64_t seed) {
  tool::Scene scene;
  const tool::Status made = tool::make_scene(kind, seed, scene);
  EXPECT_TRUE(made) << made.message;
  return scene;
}

// ---------------------------------------------------------------- merging

TEST(Evolve, MergingPairsBecomeOneSphere) { ExpectFamily({"merging-pair"}, 12); }
TEST(Evolve, RammingPairsStayTheBoundaryOfARegion) { ExpectFamily({"ramming-pair"}, 8); }

// Faces halved to cut a contact out do not stay halved: at a crease in contact at every step, edges would become ever
// shorter.
TEST(Evolve, PairsDoNotBecomeFinerWhereTheyMeet) {
  for (const char* kind : {"merging-pair", "ramming-pair"})
    for (uint64_t seed = 1; seed <= Share(4u); ++seed) {
      const tool::Scene scene = SceneOf(kind, seed);
      const Verdict v = Judge(scene, {});
      EXPECT_GE(v.evolution.substeps, 20u);
      EXPECT_LE(VertexCount(v.mesh), VertexCount(scene.mesh)) << kind << ", seed " << seed;
    }
}

// Contacts of a step are shared by its groups.
TEST(Evolve, ContactsOfGroupsAreCounted) {
  tool::EventCounts counts;
  const auto add = [&](uint32_t contacts, uint32_t groups) {
    tpa_report report{};
    report.contacts = contacts;
    report.groups = groups;
    counts.add(nullptr, report);
  };
  add(0, 0);
  add(10, 4);
  add(7, 1);
  EXPECT_EQ(counts.contacts, (std::vector<double>{2.5, 2.5, 2.5, 2.5, 7}));
  EXPECT_FALSE(Judge(SceneOf("merging-pair", 1), {}).evolution.events.contacts.empty());
}

TEST(Evolve, MergingPairsDoNotDependOnNumbering) { ExpectFamily({"merging-pair"}, 5, Pose::renumbered); }
TEST(Evolve, MergingPairsDoNotDependOnRotation) { ExpectFamily({"merging-pair"}, 5, Pose::turned); }

TEST(Evolve, ThreeMeetAtOnce) { ExpectFamily({"meeting-3"}, 12); }
TEST(Evolve, FourMeetAtOnce) { ExpectFamily({"meeting-4"}, 12); }
TEST(Evolve, FiveMeetAtOnce) { ExpectFamily({"meeting-5"}, 12); }
TEST(Evolve, EightMeetAtOnce) { ExpectFamily({"meeting-8"}, 12); }

// ---------------------------------------------------------------- the union of balls

class GrowingBalls : public testing::TestWithParam<uint32_t> {};

TEST_P(GrowingBalls, HaveTheTopologyOfTheirUnion) {
  if (!KnowsUnions()) GTEST_SKIP() << "built without CGAL: nothing to compare with";
  ExpectFamily({"balls-" + std::to_string(GetParam())}, GetParam() < 6 ? 3 : 1);
}

INSTANTIATE_TEST_SUITE_P(Evolve, GrowingBalls, testing::Values(2, 3, 4, 5, 6, 7, 8));

// Windows of a void that come together at its inner edges close all the same. In seed 24 two of them once stayed open.
TEST(EvolveLong, AVoidBetweenEightBallsIsClosed) {
  if (!KnowsUnions()) GTEST_SKIP() << "built without CGAL: nothing to compare with";
  ExpectFamily({"balls-cube"}, 2);
  ExpectFamily({"balls-cube", 24}, 1);
}

// Here the surface touched by creases reaches all round a tunnel, and was once closed by a cap.
TEST(EvolveLong, CreasesAllRoundATunnelLeaveItOpen) {
  if (!KnowsUnions()) GTEST_SKIP() << "built without CGAL: nothing to compare with";
  ExpectFamily({"balls-100", 85}, 1);
}

double SixVolumes(const std::vector<double>& p) {
  const auto from_first = [&](size_t v) { return Point{p[3 * v] - p[0], p[3 * v + 1] - p[1], p[3 * v + 2] - p[2]}; };
  return Dot(from_first(1), Cross(from_first(2), from_first(3)));
}

// The last remnant of a void, deep in a ball. The vertices of a flat remnant once went past each other, and in seed 28
// of balls-1000 the void stayed for good.
TEST(GrowingBallsMotion, TurnsTheLastRemnantOfAVoidInsideOut) {
  const tool::Scene scene = SceneOf("balls-cube", 1);
  const Point center = scene.balls->centers[0];
  const std::vector<uint32_t> triangles = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
  for (uint64_t seed = 1; seed <= Share(1000u); ++seed) {
    Random random(seed);
    std::vector<double> positions, targets(12);
    for (int v = 0; v < 4; ++v) {
      const Point p = RandomPoint(random, -scene.edge_length, scene.edge_length);
      for (size_t i = 0; i < 3; ++i) positions.push_back(center[i] + 0.2 + p[i]);
    }
    // So that it is a void.
    if (SixVolumes(positions) < 0) std::swap_ranges(positions.begin(), positions.begin() + 3, positions.begin() + 3);
    scene.motion({scene.duration - scene.step, scene.step, positions, triangles, {}}, targets);
    EXPECT_LT(SixVolumes(positions) * SixVolumes(targets), 0) << "seed " << seed;
  }
}

// The oracle itself, on plain cases.
TEST(UnionOfBalls, OfAFewIsKnown) {
  if (!KnowsUnions()) GTEST_SKIP() << "built without CGAL";
  const auto betti = [](const std::vector<tool::Point>& centers, double radius) {
    return BettiOfUnion(centers, radius, 0.01).value_or(Betti{-1, -1, -1});
  };
  EXPECT_EQ(betti({{0, 0, 0}}, 1), (Betti{1, 0, 0}));
  EXPECT_EQ(betti({{0, 0, 0}, {2, 0, 0}}, 0.9), (Betti{2, 0, 0}));
  EXPECT_EQ(betti({{0, 0, 0}, {2, 0, 0}}, 1.1), (Betti{1, 0, 0}));
  EXPECT_EQ(BettiOfUnion({{0, 0, 0}, {2, 0, 0}}, 1.005, 0.01), std::nullopt);
  // An equilateral triangle of side 2: its tunnel is open from 1 to 2 / sqrt(3).
  const std::vector<tool::Point> triangle = {{0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0}};
  EXPECT_EQ(betti(triangle, 1.1), (Betti{1, 1, 0}));
  EXPECT_EQ(betti(triangle, 1.2), (Betti{1, 0, 0}));
  // A regular tetrahedron of side 2: three tunnels, then a void from 2 / sqrt(3) to sqrt(3 / 2).
  const std::vector<tool::Point> tetrahedron = {
      {0, 0, 0}, {2, 0, 0}, {1, std::sqrt(3.0), 0}, {1, 1 / std::sqrt(3.0), std::sqrt(8.0 / 3)}};
  EXPECT_EQ(betti(tetrahedron, 1.1), (Betti{1, 3, 0}));
  EXPECT_EQ(betti(tetrahedron, 1.19), (Betti{1, 0, 1}));
  EXPECT_EQ(betti(tetrahedron, 1.3), (Betti{1, 0, 0}));
}

// ---------------------------------------------------------------- splitting

TEST(Evolve, ADumbbellPinchesIntoTwo) { ExpectFamily({"dumbbell"}, 1); }
TEST(Evolve, ATubeNecksOffWhateverItsLength) { ExpectFamily({"tube"}, 4); }
TEST(Evolve, AShellPiercedFromBothSidesHasAHole) { ExpectFamily({"shell"}, 2); }
TEST(Evolve, ARingCloses) { ExpectFamily({"ring"}, 2); }

TEST(Evolve, WhatShrinksToNothingDies) {
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    const Verdict v = Judge(Play{"vanish", seed});
    EXPECT_TRUE(v.Good()) << v.fault;
    EXPECT_EQ(v.evolution.events.death, 1u) << "seed " << seed;
  }
}

// ---------------------------------------------------------------- known answers

// Half way, at t = 1, in evolve_figures.
TEST(EvolveLong, SpheresThatGrowAndShrinkHaveTheKnownVolume) { ExpectFamily({"grow-and-shrink"}, 1); }

// To their ends in evolve_figures.
TEST(Evolve, FlowsStayClean) {
  for (const char* kind : {"enright", "curl-noise"}) {
    tool::Scene scene = SceneOf(kind, 1);
    scene.duration = 25 * scene.step;
    scene.end.reset();
    scene.volume = 0;
    const Verdict v = Judge(scene, {});
    EXPECT_TRUE(v.Good()) << kind << ": " << v.fault;
  }
}

// ---------------------------------------------------------------- large steps

class LargeStepsLong : public testing::TestWithParam<int> {};

// Kinds playable in a second or so.
constexpr const char* quick_kinds[] = {"merging-pair", "ramming-pair", "meeting-3", "meeting-4", "meeting-5", "balls-2",
                                       "balls-3",      "balls-4",      "tube",      "shell",     "ring",      "vanish"};

// A known end is also reached. Exception: the first scene of balls-4, grown by 16 edges before it is remeshed, is too
// coarse to meet (docs/evaluation.md). Ends of balls are known with CGAL only.
TEST_P(LargeStepsLong, CutToWhatCannotPassThroughStayClean) {
  for (const std::string kind : quick_kinds) {
    if (kind.starts_with("balls") && !KnowsUnions()) continue;
    if (GetParam() < 16 || kind != "balls-4") ExpectFamily({.kind = kind, .stride = 1.0 * GetParam()}, 1);
  }
}

TEST_P(LargeStepsLong, InOneStayClean) {
  for (const char* kind : quick_kinds) ExpectFamily({.kind = kind, .stride = 1.0 * GetParam(), .substeps = false}, 1);
}

INSTANTIATE_TEST_SUITE_P(Evolve, LargeStepsLong, testing::Values(1, 4, 16));

TEST(Evolve, WhatMayPassThroughUnnoticedIsCutOrReported) {
  // A pea shot through a sheet: in one step the pea is beyond.
  tool::Scene scene;
  scene.mesh = tool::make_sphere({-1, 0.02, 0.01}, 0.2, 4);
  const Mesh sheet = Box({-0.1, -1, -1}, {0.1, 1, 1}, 8);
  const uint32_t pea = VertexCount(scene.mesh);
  scene.mesh = Together({scene.mesh, sheet});
  scene.motion = [=](const tool::Moment& m, std::vector<double>& targets) {
    for (size_t v = 0; v < m.vertices() && m.vertices() == VertexCount(scene.mesh); ++v)
      if (v < pea) targets[3 * v] += 2 * m.step;
  };
  scene.step = scene.duration = 1;
  tool::EvolutionOptions options;
  options.substeps = false;
  const Verdict through = Judge(scene, options);
  EXPECT_TRUE(through.Good()) << through.fault;
  EXPECT_EQ(through.evolution.long_steps, 1u);
  EXPECT_EQ(through.evolution.events.merge, 0u);
  const Verdict met = Judge(scene, {});
  EXPECT_TRUE(met.Good()) << met.fault;
  EXPECT_EQ(met.evolution.long_steps, 0u);
  EXPECT_GT(met.evolution.substeps, 1u);
  EXPECT_GE(met.evolution.events.merge, 1u);
}

// ---------------------------------------------------------------- what once went wrong

struct Regression {
  const char* kind;
  uint64_t seed;
  double stride;
  uint64_t renumber = 0;
};

std::string NameOf(const Regression& r) {
  std::string name = tool::text_of(r.kind, "_", r.seed);
  if (r.renumber > 0) name += tool::text_of("_renumber_", r.renumber);
  if (r.stride > 0) name += tool::text_of("_stride_", r.stride);
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
}
void PrintTo(const Regression& r, std::ostream* out) { *out << NameOf(r); }

class Regressions : public testing::TestWithParam<Regression> {};

TEST_P(Regressions, EndAsTheyShould) {
  const Regression& r = GetParam();
  const Play play{.kind = r.kind, .seed = r.seed, .renumber = r.renumber, .stride = r.stride};
  const Verdict v = Judge(play);
  EXPECT_TRUE(v.Good()) << play.Command() << ": " << v.fault;
}

constexpr Regression regressions[] = {
    {"merging-pair", 12, 0},
    {"merging-pair", 14, 0},
    {"merging-pair", 31, 0},
    {"merging-pair", 40, 0},
    {"merging-pair", 45, 0},
    {"merging-pair", 50, 0},
    {"merging-pair", 52, 0},
    {"merging-pair", 68, 0},
    {"merging-pair", 80, 0},
    {"merging-pair", 99, 0},
    {"merging-pair", 1, 1},
    {"merging-pair", 2, 1},
    {"merging-pair", 2, 4},
    {"merging-pair", 715, 0},
    {"merging-pair", 258, 0, 258},
    {"merging-pair", 277, 0, 277},
    {"merging-pair", 616, 0, 616},
    {"merging-pair", 655, 0, 655},
    {"merging-pair", 6, 16},
    {"merging-pair", 33, 16},
    {"merging-pair", 67, 16},
    {"merging-pair", 195, 16},
    {"merging-pair", 220, 16},
    {"merging-pair", 178, 16},
    {"ring", 1, 16},
    {"ring", 4, 16},
    {"ramming-pair", 3, 0},
    {"ramming-pair", 5, 0},
    {"ramming-pair", 10, 0},
    {"ramming-pair", 12, 0},
    {"ramming-pair", 28, 0},
    {"balls-5", 16, 0},
    {"meeting-3", 10, 0},
    {"meeting-3", 26, 0},
    {"meeting-4", 10, 0},
    {"meeting-4", 27, 0},
    {"meeting-5", 22, 0},
    {"meeting-5", 24, 0},
    {"meeting-8", 1, 0},
    {"meeting-8", 14, 0},
    {"balls-2", 1, 4},
    {"balls-2", 8, 16},
    {"balls-5", 33, 4},
    {"balls-6", 9, 4},
    {"balls-6", 48, 4},
    {"balls-3", 2, 1},
    {"balls-4", 1, 1},
    {"balls-4", 11, 0},
    {"balls-4", 12, 0},
    {"balls-8", 5, 0},
    {"balls-8", 76, 0},
    {"ring", 1, 1},
    {"vanish", 1, 0},
    {"vanish", 3, 0},
    {"vanish", 5, 4},
    {"vanish", 2, 16},
    {"balls-cube", 7, 0},
    {"balls-100", 11, 0},
};
// In seed 2 islands meet after both are done, and begin again.
constexpr Regression long_regressions[] = {
    {"balls-100", 2, 0}, {"balls-100", 29, 0}, {"balls-100", 31, 0}, {"balls-100", 89, 0}, {"balls-100", 100, 0}};

// The longest first.
INSTANTIATE_TEST_SUITE_P(EvolveLong, Regressions, testing::ValuesIn(long_regressions),
                         [](const auto& given) { return NameOf(given.param); });
INSTANTIATE_TEST_SUITE_P(Evolve, Regressions, testing::ValuesIn(regressions),
                         [](const auto& given) { return NameOf(given.param); });

// ---------------------------------------------------------------- failures

// Random limits make calls fail at every possible place; no state may show a trace of the failure.
TEST(Evolve, AFailedStepLeavesEveryByteAsItWas) {
  uint32_t failures = 0, limits = 0;
  for (uint64_t seed = 1; seed <= Share(60u); ++seed) {
    Random random(seed);
    const tool::Scene scene = SceneOf("merging-pair", 1 + seed % 12);
    const uint32_t n = VertexCount(scene.mesh);
    const auto some = [&](uint32_t least, uint32_t most) {
      return least + static_cast<uint32_t>(random() % (most - least));
    };
    tpa_config config = DefaultConfig(n + 1000);
    config.max_contacts = seed % 3 == 0 ? some(4, 200) : 4096;
    config.max_cut_edges = seed % 3 == 1 ? some(4, 60) : 4096;
    config.max_events = seed % 3 == 2 ? some(1, 4) : 256;
    Arena arena(config, scene.mesh);
    std::vector<double> targets;
    for (int step = 0; step < 20; ++step) {
      const Mesh before = MeshOf(*arena);
      targets = before.positions;
      scene.motion({step * scene.step, scene.step, before.positions, before.triangles, {}}, targets);
      ASSERT_EQ(MoveAll(*arena, targets), TPA_OK);
      const Observed state = Observe(*arena);
      tpa_issue issue;
      if (tpa_step(*arena, nullptr, nullptr, &issue) == TPA_OK) continue;
      EXPECT_EQ(issue.status, TPA_E_LIMIT) << "seed " << seed << ": " << Text(issue);
      EXPECT_TRUE(Observe(*arena) == state) << "seed " << seed << ", step " << step << ": " << Text(issue);
      ++failures;
      limits |= 1u << issue.limit;
      break;
    }
  }
  EXPECT_GE(failures, Least(20u));
  EXPECT_EQ(limits, 1u << TPA_LIMIT_CONTACTS | 1u << TPA_LIMIT_CUT | 1u << TPA_LIMIT_EVENTS);
}

}  // namespace
}  // namespace evolve_test
