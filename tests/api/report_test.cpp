// SPDX-License-Identifier: MIT
// What a report tells of the region: volumes lost and gained and their reach from the triangles in contact, against
// columns of rays (P3). `report_figures` plays more seeds, in a table.
#include <gtest/gtest.h>

#include "support/report_trial.h"
#include "support/share.h"

namespace report_test {
namespace {

using namespace support;

// ---------------------------------------------------------------- the judge

struct Known {
  Mesh given, result;
  std::vector<TriangleCorners> contacts;
  double volume = 0, reach = 0;
};

// Of two boxes the smaller goes. One triangle of the larger counts as in contact: its top at z = 2, seen from the top
// of the smaller box, 3 farther up.
Known ABoxGoes() {
  const Mesh box = Box({0, 0, 0}, {2, 2, 2}, 1), other = Box({0.25, 0.25, 4}, {0.75, 0.75, 5}, 1);
  return {Together({box, other}), box, {{Point{-9, -9, 2}, Point{19, -9, 2}, Point{-9, 19, 2}}}, 0.25, 3};
}

tpa_report Claims(double lost, double gained, double reach) {
  tpa_report report = Sized<tpa_report>();
  report.region_lost = lost, report.region_gained = gained, report.region_reach = reach;
  return report;
}

TEST(ReportJudge, MeasuresAKnownChange) {
  const Known k = ABoxGoes();
  const auto judge = [&](double lost, double gained, double reach) {
    return JudgeReport(k.given, k.result, k.contacts, Claims(lost, gained, reach), 1);
  };
  const ReportVerdict right = judge(k.volume, 0, k.reach);
  EXPECT_NEAR(right.measured.lost, k.volume, right.lost_error) << right.text;
  EXPECT_LT(right.lost_error, 0.1 * k.volume);
  EXPECT_EQ(right.measured.gained, 0);
  EXPECT_NEAR(right.measured.reach, k.reach, 1e-9);
  EXPECT_LT(right.measured.cell, 0.1);
  EXPECT_FALSE(right.volume_less || right.volume_twice || right.reach_less || right.reach_twice) << right.text;
  EXPECT_TRUE(judge(0.9 * k.volume, 0, k.reach).volume_less);
  EXPECT_TRUE(judge(0, k.volume, k.reach).volume_less);  // the same sum
  EXPECT_TRUE(judge(1.2 * k.volume, k.volume, k.reach).volume_twice);
  EXPECT_TRUE(judge(k.volume, 0, 0.99 * k.reach).reach_less);
  EXPECT_TRUE(judge(k.volume, 0, 2.2 * k.reach).reach_twice);
  const ReportVerdict gains = JudgeReport(k.result, k.given, k.contacts, Claims(0, k.volume, k.reach), 1);
  EXPECT_FALSE(gains.volume_less || gains.volume_twice || gains.reach_less || gains.reach_twice) << gains.text;
}

TEST(ReportJudge, FindsTrianglesInContact) {
  const Mesh a = Box({0, 0, 0}, {2, 2, 2}, 1), apart = Box({5, 0, 0}, {6, 1, 1}, 1), in = Box({1, 1, 1}, {3, 3, 3}, 1);
  EXPECT_TRUE(TrianglesInContact(Together({a, apart})).empty());
  EXPECT_GE(TrianglesInContact(Together({a, apart, in})).size(), 6u);
}

// ---------------------------------------------------------------- reports of steps

struct Counts {
  uint32_t steps = 0, volume_less = 0, volume_twice = 0, reach_less = 0, reach_twice = 0;
};

Counts CountUpTo(uint64_t seeds) {
  Counts c;
  for (const ReportFamily& family : ReportFamilies())
    for (uint64_t seed = 1; seed <= seeds; ++seed) {
      const ReportTrial t = PlayReport(family, seed);
      if (!t.IsJudged()) continue;
      ++c.steps;
      c.volume_less += t.verdict.volume_less, c.volume_twice += t.verdict.volume_twice;
      c.reach_less += t.verdict.reach_less, c.reach_twice += t.verdict.reach_twice;
      EXPECT_FALSE(t.verdict.volume_less) << family.name << " " << seed << ": " << t.Text();
    }
  return c;
}

// Open faults (docs/evaluation.md): moves that are taken back count on both sides, so volumes may be told more than
// twice; each sweep is measured from a single triangle, so the reach may be. No more steps may be at fault.
TEST(Report, TellsNoLessThanColumnsMeasure) {
  const Counts c = CountUpTo(Share(2u));
  EXPECT_GE(c.steps, Least(25u));
  EXPECT_LE(c.volume_twice, 0u);
  EXPECT_EQ(c.reach_less, 0u);
  EXPECT_LE(c.reach_twice, 5u);
}

TEST(ReportLong, TellsNoLessThanColumnsMeasure) {
  const Counts c = CountUpTo(20);
  EXPECT_GE(c.steps, 300u);
  EXPECT_LE(c.volume_twice, 2u);
  EXPECT_EQ(c.reach_less, 0u);
  EXPECT_LE(c.reach_twice, 42u);
}

}  // namespace
}  // namespace report_test
