// SPDX-License-Identifier: MIT
// tpa_step where much goes wrong at once, or sampling is uneven: the result bounds the region of the moved mesh, or the
// call refuses (P3). `step_figures` plays more seeds, in a table.
#include <algorithm>

#include "support/share.h"
#include "support/step_noise.h"

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

// In the paper's way these would lose one part of the region and gain another, with hardly a change of the volume.
TEST(StepRegionLosses, AreNotHiddenByGains) {
  const auto play = [](const std::string& name, uint64_t seed) {
    const std::vector<StepFamily> family = FamiliesThat([&](const StepFamily& f) { return f.name == name; });
    ASSERT_EQ(family.size(), 1u);
    PlayAndJudge(family[0], seed);
  };
  play("noise-slab-434-by-50", 11);
  play("spring-coarse", 17);
}

// ---------------------------------------------------------------- all families

class NoiseRegionsLong : public testing::TestWithParam<StepFamily> {};

TEST_P(NoiseRegionsLong, AreThoseOfTheMovedMesh) {
  const uint64_t seeds = IsSlow(GetParam()) ? 2 : IsRepeated(GetParam()) ? 4 : 20;
  for (uint64_t seed = 1; seed <= seeds; ++seed) PlayAndJudge(GetParam(), seed);
}

INSTANTIATE_TEST_SUITE_P(Noise, NoiseRegionsLong, testing::ValuesIn(NoiseStepFamilies()), NameOf);

// Open faults (docs/evaluation.md) leave some seeds wrong. Of the first twenty so many came out right, and no fewer
// may.
struct RightOf20 {
  const char* family;
  uint32_t right;
};

constexpr RightOf20 right_of_20[] = {{"uneven-globes-6x120-by-30", 13},
                                     {"uneven-globes-6x120-by-6", 15},
                                     {"uneven-globes-120x6-by-30", 17},
                                     {"uneven-globes-120x6-by-6", 20},
                                     {"uneven-slivers-by-30", 20},
                                     {"uneven-slivers-by-6", 20},
                                     {"uneven-slivers-fine-by-30", 20},
                                     {"uneven-slivers-fine-by-6", 20},
                                     {"uneven-octahedron-fine-by-30", 20},
                                     {"uneven-octahedron-fine-by-6", 20},
                                     {"uneven-graded-300-by-30", 12},
                                     {"uneven-graded-300-by-6", 15},
                                     {"spring-coarse", 18},
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

// ---------------------------------------------------------------- bodies that were flat

Mesh ScaledAbout(const Mesh& m, uint32_t first, uint32_t last, Point center, double by) {
  Mesh out = m;
  for (uint32_t v = first; v < last; ++v)
    for (size_t k = 0; k < 3; ++k) out.positions[3 * v + k] = center[k] + by * (m.positions[3 * v + k] - center[k]);
  return out;
}

// Shrinks the body of vertices first .. last-1 to a point, and opens it to `by` times its size; negative: inside out.
Mesh ShrunkAndOpened(const Mesh& m, uint32_t first, uint32_t last, Point center, double by) {
  const Arena arena(ConfigFor(m), m);
  for (double scale : {0., by}) {
    EXPECT_EQ(MoveAll(*arena, ScaledAbout(m, first, last, center, scale).positions), TPA_OK);
    EXPECT_EQ(tpa_step(*arena, nullptr, nullptr, nullptr), TPA_OK);
    if (scale == 0) {
      EXPECT_EQ(VertexCount(MeshOf(*arena)), VertexCount(m));
    }
  }
  return MeshOf(*arena);
}

const Mesh tetrahedron = {{-1, -1, -1, 3, -1, -1, -1, 3, -1, -1, -1, 3}, {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3}};

// A volume of zero has no sign, so its change tells nothing. All faces of a tetrahedron have common edges: as a point
// it is free of self-intersections.
TEST(StepOfAPoint, GoesIfItOpensInsideOut) {
  EXPECT_EQ(VertexCount(ShrunkAndOpened(tetrahedron, 0, 4, {1, 2, 3}, -1)), 0u);
  EXPECT_EQ(VertexCount(ShrunkAndOpened(tetrahedron, 0, 4, {1, 2, 3}, .5)), 4u);
}

TEST(StepOfAPoint, StaysIfItOpensAsAVoid) {
  Mesh hollow = tetrahedron;
  for (size_t f = 0; f < hollow.triangles.size(); f += 3) std::swap(hollow.triangles[f], hollow.triangles[f + 1]);
  hollow = Together({hollow, Sphere({}, 9, 3)});
  EXPECT_EQ(VertexCount(ShrunkAndOpened(hollow, 0, 4, {}, .8)), VertexCount(hollow));
  EXPECT_EQ(VertexCount(ShrunkAndOpened(hollow, 0, 4, {}, -.8)), VertexCount(hollow) - 4);
}

}  // namespace
