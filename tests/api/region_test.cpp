// SPDX-License-Identifier: MIT
// tpa_adapt on meshes from the field: the result bounds the region of winding number >= 1, or the call refuses (P3).
// `region_figures` plays more seeds, in a table.
#include <algorithm>

#include "support/region_trial.h"
#include "support/share.h"

namespace region_test {
namespace {

using namespace support;

// Nothing comes out wrong, and no more than so many meshes are refused.
void ExpectRegions(const FieldFamily& family, uint64_t first, uint64_t last, uint32_t most_refused) {
  uint32_t refused = 0;
  for (uint64_t seed = first; seed <= last; ++seed) {
    const Mesh given = MakeFieldMesh(family, seed);
    if (given.triangles.empty()) GTEST_SKIP() << "no real meshes here";
    const std::string name = family.name + "-" + std::to_string(seed);
    const RegionTrial t = TryRegion(family, given, seed);
    const MeshOnFailure before(name, given), after(name + "-result", t.result);
    EXPECT_NE(t.verdict.outcome, Outcome::wrong) << name << ": " << t.verdict.reason;
    refused += t.verdict.outcome == Outcome::refused ? 1u : 0u;
  }
  EXPECT_LE(refused, most_refused);
}

// resolve_test plays tangles.
std::vector<FieldFamily> FamiliesWithoutTangles() {
  std::vector<FieldFamily> families;
  for (const FieldFamily& f : FieldFamilies())
    if (f.name.rfind("tangle-", 0) != 0) families.push_back(f);
  return families;
}

std::string NameOf(const testing::TestParamInfo<FieldFamily>& info) {
  std::string name = info.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

constexpr uint64_t first_seeds = 2, long_seeds = 12;
constexpr uint32_t many = 300;  // seeds of families of small meshes

class Regions : public testing::TestWithParam<FieldFamily> {};

TEST_P(Regions, AreThoseOfTheGivenMesh) {
  ExpectRegions(GetParam(), 1, GetParam().count < many ? 1 : Share(first_seeds), 0);
}

void ExpectRegion(const std::string& name, uint64_t seed) {
  const std::vector<FieldFamily>& families = FieldFamilies();
  const auto family = std::find_if(families.begin(), families.end(), [&](const auto& f) { return f.name == name; });
  ASSERT_NE(family, families.end());
  ExpectRegions(*family, seed, seed, 0);
}

// Two wedges touch in a slanted edge: on most grids cells of both share faces there.
TEST(RegionsOfOneSeed, TouchingWedgesMayComeApart) { ExpectRegion("prisms-grid", 390); }

// A cut left tetrahedra with three corners in one place, and larger specks without a volume.
TEST(RegionsOfOneSeed, NoSpeckHasCornersInOnePlace) {
  ExpectRegion("frame-fine", 59);
  ExpectRegion("frame-fine", 275);
}

INSTANTIATE_TEST_SUITE_P(Field, Regions, testing::ValuesIn(FamiliesWithoutTangles()), NameOf);

class RegionsLong : public testing::TestWithParam<FieldFamily> {};

// A few at a time of a family may be refused; RefusalsLong counts them.
TEST_P(RegionsLong, AreThoseOfTheGivenMesh) {
  const uint64_t last = std::min<uint64_t>(GetParam().count, first_seeds + long_seeds);
  ExpectRegions(GetParam(), first_seeds + 1, last, long_seeds / 3);
}

INSTANTIATE_TEST_SUITE_P(Field, RegionsLong, testing::ValuesIn(FamiliesWithoutTangles()), NameOf);

TEST(RefusalsLong, AreOneInAHundredAtMost) {
  uint32_t played = 0, refused = 0;
  for (const FieldFamily& family : FamiliesWithoutTangles())
    for (uint64_t seed = 1; seed <= std::min(family.count, 20u); ++seed) {
      const Mesh given = MakeFieldMesh(family, seed);
      if (given.triangles.empty()) break;  // no real meshes here
      const RegionTrial t = TryToAdapt(given);
      EXPECT_NE(t.verdict.outcome, Outcome::wrong) << family.name << " " << seed << ": " << t.verdict.reason;
      ++played;
      refused += t.verdict.outcome == Outcome::refused ? 1u : 0u;
    }
  EXPECT_GT(played, 500u);
  EXPECT_LE(100 * refused, played);
}

}  // namespace
}  // namespace region_test
