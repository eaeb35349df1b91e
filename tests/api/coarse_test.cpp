// SPDX-License-Identifier: MIT
// Moves of few and of all vertices of coarse bodies: a tpa_step changes the region by no more than P3 allows, or holds
// vertices back, and its report never tells less than columns of rays measure. `coarse_figures` counts more seeds.
#include "oracle/region_columns.h"
#include "support/coarse_trial.h"
#include "support/share.h"

namespace coarse_test {
namespace {

using namespace support;

class CoarseBodies : public testing::TestWithParam<CoarseFamily> {};
class CoarseBodiesLong : public CoarseBodies {};

void PlaySeeds(const CoarseFamily& family, uint64_t from, uint64_t to) {
  uint64_t met = 0;
  for (uint64_t seed = from; seed <= to; ++seed) {
    const CoarseTrial t = PlayCoarse(family, seed);
    const std::string name = family.name + "-" + std::to_string(seed);
    const MeshOnFailure before(name + "-before", t.step.before), moved(name + "-moved", t.step.moved),
        result(name + "-result", t.step.result);
    met += t.meets ? 1 : 0;
    EXPECT_EQ(t.fault, "") << name;
    EXPECT_EQ(t.step.status, TPA_OK) << name << ": " << Text(t.step.issue);
    EXPECT_FALSE(t.IsOver()) << name << ": the region changes by " << t.changed << " +- " << t.error << " of "
                             << t.volume << ", allowed are " << t.allowed << ", and nothing is held back";
    EXPECT_FALSE(t.TellsLess()) << name << ": the report tells " << t.told << ", the region changes by " << t.changed
                                << " +- " << t.error;
  }
  EXPECT_GT(met, (to - from + 1) / 10);
}

// Steps of all vertices take longest.
TEST_P(CoarseBodies, ChangeWithinTheBoundOrHoldVerticesBack) {
  PlaySeeds(GetParam(), 1, Share(GetParam().moving == 0 ? 8u : 26u));
}
TEST_P(CoarseBodiesLong, ChangeWithinTheBoundOrHoldVerticesBack) {
  PlaySeeds(GetParam(), 1001, GetParam().moving == 0 ? 1050 : 1300);
}

// The judge itself: a dent, whose volume is the difference of both volumes, on one of two bodies.
TEST(CoarseJudge, MeasuresADent) {
  const Mesh box = Box({-1, -1, -1}, {1, 1, 1}, 2), other = Sphere({0, 0, 60}, 20, 2);
  for (const double depth : {1e-4, 0.1, 0.7}) {
    const Mesh dented = Mapped(box, [&](const Point& p) { return p == Point{0, 0, 1} ? Point{0, 0, 1 - depth} : p; });
    const double volume = TopologyOf(box).Volume() - TopologyOf(dented).Volume();
    const RegionDifference d = CompareChanges(Together({box, other}), Together({dented, other}), 1000, 1);
    EXPECT_NEAR(d.lost, volume, 3 * d.error) << depth;
    EXPECT_EQ(d.gained, 0) << depth;
    EXPECT_LT(d.error, 0.1 * volume) << depth;
    EXPECT_TRUE(d.is_plain);
    const RegionDifference back = CompareChanges(Together({dented, other}), Together({box, other}), 1000, 1);
    EXPECT_EQ(back.gained, d.lost);
    EXPECT_EQ(back.lost, 0);
  }
  EXPECT_EQ(CompareChanges(box, box, 1000, 1).lost, 0);
}

std::string NameOf(const testing::TestParamInfo<CoarseFamily>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Moves, CoarseBodies, testing::ValuesIn(CoarseFamilies()), NameOf);
INSTANTIATE_TEST_SUITE_P(Moves, CoarseBodiesLong, testing::ValuesIn(CoarseFamilies()), NameOf);

}  // namespace
}  // namespace coarse_test
