// SPDX-License-Identifier: MIT
// tpa_step where much goes wrong at once, or sampling is uneven: the result bounds the region of the moved mesh, or the
// call refuses (P3). `step_figures` plays more seeds, in a table.
#include <algorithm>

#include "oracle/exact.h"
#include "oracle/winding_grid.h"
#include "support/share.h"
#include "support/step_noise.h"
#include "support/tangle_shapes.h"

namespace step_region_test {
namespace {

using namespace support;

bool StartsWith(const std::string& name, const char* start) { return name.rfind(start, 0) == 0; }
bool IsRepeated(const StepFamily& family) { return family.name.find("-times-8") != std::string::npos; }

// Eight times the same noise makes ever more contacts, until a limit ends the run.
bool MayRefuse(const StepFamily& family, const StepTrial& t) { return IsRepeated(family) && t.status == TPA_E_LIMIT; }

StepTrial PlayAndJudge(const StepFamily& family, uint64_t seed) {
  const StepTrial t = family.play(seed);
  const std::string name = family.name + "-" + std::to_string(seed);
  const MeshOnFailure before(name + "-before", t.before), moved(name + "-moved", t.moved),
      result(name + "-result", t.result);
  EXPECT_NE(t.outcome, Outcome::wrong) << name << ": " << t.reason;
  if (t.outcome == Outcome::refused) {
    EXPECT_TRUE(MayRefuse(family, t)) << name << ": " << t.reason;
  }
  return t;
}

std::string NameOf(const testing::TestParamInfo<StepFamily>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

template <class Takes>
std::vector<StepFamily> FamiliesThat(Takes takes) {
  std::vector<StepFamily> families;
  for (const StepFamily& f : StepFamilies())
    if (takes(f)) families.push_back(f);
  return families;
}

// ---------------------------------------------------------------- a few seeds

bool IsSlow(const StepFamily& family) { return StartsWith(family.name, "noise-sphere-1602"); }

class StepRegions : public testing::TestWithParam<StepFamily> {};

TEST_P(StepRegions, AreThoseOfTheMovedMesh) {
  const uint64_t seeds = IsSlow(GetParam()) || IsRepeated(GetParam()) ? 1 : 2;
  for (uint64_t seed = 1; seed <= seeds; ++seed) PlayAndJudge(GetParam(), seed);
}

INSTANTIATE_TEST_SUITE_P(Noise, StepRegions, testing::ValuesIn(FamiliesThat([](const StepFamily& f) {
                           return StartsWith(f.name, "noise-") && !IsRepeated(f);
                         })),
                         NameOf);
INSTANTIATE_TEST_SUITE_P(RepeatedNoise, StepRegions, testing::ValuesIn(FamiliesThat([](const StepFamily& f) {
                           return StartsWith(f.name, "noise-sphere-66") && IsRepeated(f);
                         })),
                         NameOf);
INSTANTIATE_TEST_SUITE_P(Uneven, StepRegions, testing::ValuesIn(FamiliesThat([](const StepFamily& f) {
                           return StartsWith(f.name, "uneven-slivers") || f.name == "spring-fine";
                         })),
                         NameOf);

void PlayAndJudge(const std::string& name, uint64_t seed) {
  const std::vector<StepFamily> family = FamiliesThat([&](const StepFamily& f) { return f.name == name; });
  ASSERT_EQ(family.size(), 1u);
  PlayAndJudge(family[0], seed);
}

// In the paper's way these would lose one part of the region and gain another, with hardly a change of the volume.
TEST(StepRegionLosses, AreNotHiddenByGains) {
  PlayAndJudge("noise-slab-434-by-50", 11);
  PlayAndJudge("spring-coarse", 17);
}

// Handles between triangles of half a radius, on bodies of much smaller ones: they would change the volume by 2 %.
TEST(StepRegionLosses, AreBoundWhereTrianglesAreUneven) {
  PlayAndJudge("uneven-graded-300-by-30", 2);
  PlayAndJudge("uneven-graded-300-by-6", 17);
}

// The exact cut alone leaves tunnels along the seam here, up to 68 in a step.
TEST(StepRegionTunnels, ThinnerThanTheTrianglesClose) {
  PlayAndJudge("spring-coarse", 3);
  PlayAndJudge("spring-coarse", 20);
  PlayAndJudge("uneven-globes-6x120-by-30", 2);
}

// ---------------------------------------------------------------- all families

class NoiseRegionsLong : public testing::TestWithParam<StepFamily> {};

TEST_P(NoiseRegionsLong, AreThoseOfTheMovedMesh) {
  const uint64_t many = IsRepeated(GetParam()) ? 2 : 20;
  const uint64_t seeds = IsSlow(GetParam()) ? (many + 9) / 10 : many;
  for (uint64_t seed = 1; seed <= seeds; ++seed) PlayAndJudge(GetParam(), seed);
}

INSTANTIATE_TEST_SUITE_P(Noise, NoiseRegionsLong, testing::ValuesIn(NoiseStepFamilies()), NameOf);

// Open faults (docs/evaluation.md) leave some seeds wrong. Of the first twenty so many came out right, and no fewer
// may.
struct RightOf20 {
  const char* family;
  uint32_t right;
};

constexpr RightOf20 right_of_20[] = {{"uneven-globes-6x120-by-30", 19},
                                     {"uneven-globes-6x120-by-6", 19},
                                     {"uneven-globes-120x6-by-30", 19},
                                     {"uneven-globes-120x6-by-6", 19},
                                     {"uneven-slivers-by-30", 20},
                                     {"uneven-slivers-by-6", 20},
                                     {"uneven-slivers-fine-by-30", 20},
                                     {"uneven-slivers-fine-by-6", 20},
                                     {"uneven-octahedron-fine-by-30", 20},
                                     {"uneven-octahedron-fine-by-6", 20},
                                     {"uneven-graded-300-by-30", 19},
                                     {"uneven-graded-300-by-6", 19},
                                     {"uneven-slivers-long-by-30", 19},
                                     {"uneven-slivers-long-by-6", 19},
                                     {"spring-coarse", 20},
                                     {"spring-fine", 20}};

class UnevenRegionsLong : public testing::TestWithParam<RightOf20> {};

TEST_P(UnevenRegionsLong, AreAsOftenRightAsBefore) {
  const RightOf20& given = GetParam();
  const std::vector<StepFamily> family = FamiliesThat([&](const StepFamily& f) { return f.name == given.family; });
  ASSERT_EQ(family.size(), 1u);
  uint32_t right = 0;
  std::string reasons;
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    const StepTrial t = family[0].play(seed);
    if (t.outcome == Outcome::right)
      ++right;
    else
      reasons += "seed " + std::to_string(seed) + ": " + t.reason + "\n";
  }
  EXPECT_GE(right, given.right) << reasons;
}

TEST(UnevenRegions, OfAllFamiliesAreCounted) {
  EXPECT_EQ(std::size(right_of_20), UnevenStepFamilies().size() + SpringStepFamilies().size());
}

INSTANTIATE_TEST_SUITE_P(Steps, UnevenRegionsLong, testing::ValuesIn(right_of_20), [](const auto& given) {
  std::string name = given.param.family;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

// ---------------------------------------------------------------- bodies that were flat but for rounding

Mesh Tetrahedron(const Point& a, const Point& b, const Point& c, const Point& apex) {
  Mesh m{{}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}};
  for (const Point& p : {a, b, c, apex}) m.positions.insert(m.positions.end(), p.begin(), p.end());
  return m;
}

// A volume within rounding has no sign, so a change of the sign tells nothing.
TEST(StepOfAThinBody, GoesIfItOpensInsideOut) {
  int tried = 0;
  for (uint64_t seed = 1; seed <= 200; ++seed) {
    Random random(seed);
    const Point a = RandomPoint(random, -1, 1), b = RandomPoint(random, -1, 1), c = RandomPoint(random, -1, 1);
    const Point normal = Unit(Cross(Difference(b, a), Difference(c, a))), middle = Scaled(1 / 3., Sum(a, Sum(b, c)));
    const Mesh open = Tetrahedron(a, b, c, Sum(middle, normal)), thin = Tetrahedron(a, b, c, middle);
    if (Side(PositionOf(thin, 0), PositionOf(thin, 1), PositionOf(thin, 2), PositionOf(thin, 3)) !=
        Side(PositionOf(open, 0), PositionOf(open, 1), PositionOf(open, 2), PositionOf(open, 3)))
      continue;  // flat, or inside out already
    ++tried;
    const Mesh inverted = Tetrahedron(a, b, c, Sum(middle, Scaled(-1, normal)));
    for (bool opens_inside_out : {false, true}) {
      const Arena arena(ConfigFor(open), open);
      ASSERT_EQ(MoveAll(*arena, thin.positions), TPA_OK);
      ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
      ASSERT_EQ(VertexCount(MeshOf(*arena)), 4u) << "seed " << seed;
      ASSERT_EQ(MoveAll(*arena, opens_inside_out ? inverted.positions : open.positions), TPA_OK);
      ASSERT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
      ASSERT_EQ(VertexCount(MeshOf(*arena)), opens_inside_out ? 0u : 4u) << "seed " << seed;
    }
  }
  EXPECT_GT(tried, 50);
}

// ---------------------------------------------------------------- bodies that turn inside out in a heap of folds

// Towards the points opposite the origin, each vertex by a way of its own.
Mesh Turned(const Mesh& ball, double to, double noise, Random& random) {
  return Mapped(ball, [&](Point p) { return Sum(Scaled(-to, p), Scaled(noise, RandomPoint(random, -1, 1))); });
}

struct TurnedTrial {
  Mesh moved, result;
  tpa_report report = Sized<tpa_report>();
};

TurnedTrial StepTo(const Mesh& m, const Mesh& moved) {
  const Arena arena(DefaultConfig(16 * VertexCount(m)), m);
  TurnedTrial t{moved, {}};
  EXPECT_EQ(MoveAll(*arena, moved.positions), TPA_OK);
  EXPECT_EQ(tpa_step(*arena, nullptr, &t.report, nullptr), TPA_OK);
  t.result = MeshOf(*arena);
  return t;
}

std::vector<Point> SortedPositions(const Mesh& m) {
  std::vector<Point> points;
  for (uint32_t v = 0; v < VertexCount(m); ++v) points.push_back(PositionOf(m, v));
  std::sort(points.begin(), points.end());
  return points;
}

double VolumeOfRegion(const Mesh& m) {
  const Lattice lattice = LatticeRound(m, 64);
  return VolumeOf(AtLeastOne(WindingNumbers(m, lattice)), lattice);
}

TEST(StepOfAHeapOfFolds, LeavesTheOtherBodiesOnly) {
  for (uint64_t seed = 1; seed <= Share(40u); ++seed) {
    Random random(seed);
    const Mesh ball = Sphere({0, 0, 0}, 0.35, 5), other = Sphere({1.2, 0.1, 0.05}, 0.5, 8);
    const Mesh turned = Turned(ball, 0.2, 0.05, random);
    const TurnedTrial t = StepTo(Together({ball, other}), Together({turned, other}));
    const std::string name = "turned-" + std::to_string(seed);
    const MeshOnFailure moved(name + "-moved", t.moved), result(name + "-result", t.result);
    EXPECT_EQ(TopologyOf(t.result).Genera(), std::vector<int64_t>{0}) << name;
    EXPECT_EQ(SortedPositions(t.result), SortedPositions(other)) << name;
    const double crumbs = VolumeOfRegion(turned);
    EXPECT_GT(t.report.region_lost, 0.85 * crumbs) << name;
    EXPECT_LT(t.report.region_lost, 1.3 * crumbs) << name;  // rather more than less
    EXPECT_EQ(t.report.region_gained, 0) << name;
  }
}

TEST(StepOfAHeapOfFolds, FillsATurnedVoid) {
  for (uint64_t seed = 1; seed <= Share(40u); ++seed) {
    Random random(seed);
    const Mesh body = Sphere({0, 0, 0}, 1, 8), hollow = Reversed(Sphere({0, 0, 0}, 0.35, 5));
    const Mesh turned = Turned(hollow, 0.2, 0.05, random);
    const TurnedTrial t = StepTo(Together({body, hollow}), Together({body, turned}));
    const std::string name = "turned-void-" + std::to_string(seed);
    const MeshOnFailure moved(name + "-moved", t.moved), result(name + "-result", t.result);
    EXPECT_EQ(SortedPositions(t.result), SortedPositions(body)) << name;
    EXPECT_EQ(t.report.region_lost, 0) << name;
    const double crumbs = VolumeOfRegion(Reversed(turned));
    EXPECT_GT(t.report.region_gained, 0.85 * crumbs) << name;
    EXPECT_LT(t.report.region_gained, 1.3 * crumbs) << name;
  }
}

// The part inside out is larger than the other, and all is crumpled; but the other part is more than crumbs.
TEST(StepOfAHeapOfFolds, KeepsAPartThatIsNotTurned) {
  for (uint64_t seed = 1; seed <= Share(20u); ++seed) {
    Random random(seed);
    const Mesh m = Mapped(Sphere({0, 0, 0}, 1, 8), [](Point p) { return Point{3 * p[0], p[1], p[2]}; });
    const Mesh moved = Mapped(m, [&](Point p) {
      const double y = p[0] > 0 ? p[1] : -1.3 * p[1], z = p[0] > 0 ? p[2] : 1.3 * p[2];
      return Sum({p[0], y, z}, Scaled(0.3, RandomPoint(random, -1, 1)));
    });
    const TurnedTrial t = StepTo(m, moved);
    const std::string name = "half-turned-" + std::to_string(seed);
    const MeshOnFailure wanted(name + "-moved", moved), result(name + "-result", t.result);
    EXPECT_LT(TopologyOf(moved).Volume(), 0) << name;
    EXPECT_GE(t.report.contacts, VertexCount(m)) << name;
    EXPECT_NEAR(VolumeOfRegion(t.result), VolumeOfRegion(moved), 0.1 * VolumeOfRegion(moved)) << name;
  }
}

}  // namespace
}  // namespace step_region_test
