// SPDX-License-Identifier: MIT
// Steps far from the origin, where doubles are sparse: free of crossing triangles (P1), or a failure that leaves all as
// it was. `offset_figures` counts more seeds.
#include "support/file_support.h"
#include "support/offset_trial.h"
#include "support/share.h"

namespace offset_test {
namespace {

using namespace support;

class Offsets : public testing::TestWithParam<OffsetFamily> {};
class OffsetsLong : public Offsets {};

void Expect(const OffsetTrial& t, const std::string& name) {
  const MeshOnFailure before(name + "-before", t.step.before), moved(name + "-moved", t.step.moved),
      result(name + "-result", t.step.result);
  EXPECT_EQ(t.fault, "") << name;
}

// Seeds `from` to `to`, and further ones until a scene has a contact: the first three of `shaken-on-at-1e6` have none.
void PlaySeeds(const OffsetFamily& family, uint64_t from, uint64_t to) {
  uint64_t meet = 0;
  for (uint64_t seed = from; seed <= to || (meet == 0 && seed < from + 12); ++seed) {
    const OffsetTrial t = PlayOffset(family, seed);
    Expect(t, family.name + "-" + std::to_string(seed));
    meet += t.meets ? 1 : 0;
  }
  EXPECT_GT(meet, 0u) << "no scene had a contact";
}

TEST_P(Offsets, LeaveNoCrossingTriangles) { PlaySeeds(GetParam(), 1, Share(12u)); }
TEST_P(OffsetsLong, LeaveNoCrossingTriangles) { PlaySeeds(GetParam(), 10001, 10000 + GetParam().long_seeds); }

std::string NameOf(const testing::TestParamInfo<OffsetFamily>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

INSTANTIATE_TEST_SUITE_P(Steps, Offsets, testing::ValuesIn(OffsetFamilies()), NameOf);
INSTANTIATE_TEST_SUITE_P(Steps, OffsetsLong, testing::ValuesIn(OffsetFamilies()), NameOf);

// Steps of version 0.2 left crossing triangles here.
TEST(OffsetsOfSeeds, LeaveNoCrossingTriangles) {
  constexpr std::pair<const char*, uint64_t> seeds[] = {{"pair-at-1e12", 299},    {"boxes-at-1e12", 184},
                                                        {"crumple-at-1e12", 68},  {"crumple-at-1e12", 105},
                                                        {"crumple-at-1e12", 116}, {"crumple-at-1e12", 290}};
  for (const auto& [name, seed] : seeds)
    for (const OffsetFamily& family : OffsetFamilies())
      if (family.name == name) Expect(PlayOffset(family, seed), family.name + "-" + std::to_string(seed));
}

TEST(OffsetOfAFile, LeavesNoCrossingTriangles) {
  const std::string from = tool::real_file("repro/far_before.off"), to = tool::real_file("repro/far_moved.off");
  if (from.empty() || to.empty()) GTEST_SKIP() << "no such meshes in " << TOPOADAPT_SHARED_DATA;
  Mesh before, moved;
  ASSERT_TRUE(tool::read_mesh(from, before));
  ASSERT_TRUE(tool::read_mesh(to, moved));
  Expect(JudgeOffset(before, moved, DefaultConfig(20000)), "far");
}

}  // namespace
}  // namespace offset_test
