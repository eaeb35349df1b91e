// SPDX-License-Identifier: MIT
// report_figures: how well region_lost, region_gained and region_reach tell what became of the region, a line of a
// Markdown table for each family of steps, judged by columns of rays. Arguments: bench/figures/seed_table.h; without
// seeds 1 .. 100 of each family. --reasons names the seeds at fault on stderr, --write writes their meshes.
#include <algorithm>
#include <cstdio>

#include "bench/figures/seed_table.h"
#include "support/report_trial.h"

namespace {

using namespace support;

struct Row {
  uint32_t runs = 0, changed = 0, less = 0, twice = 0, reach_less = 0, reach_twice = 0;
  double least = 1e300;  // told of measured reach
  void operator+=(const Row& o) {
    runs += o.runs, changed += o.changed, less += o.less, twice += o.twice;
    reach_less += o.reach_less, reach_twice += o.reach_twice;
    least = std::min(least, o.least);
  }
};

Row RowOf(const ReportTrial& t) {
  const RegionDifference& d = t.verdict.measured;
  Row row{1,
          d.lost + d.gained > 0,
          t.verdict.volume_less,
          t.verdict.volume_twice,
          t.verdict.reach_less,
          t.verdict.reach_twice};
  if (d.reach > 0) row.least = t.step.report.region_reach / d.reach;
  return row;
}

void Print(const char* family, const Row& r) {
  std::printf("| %s | %u | %u | %u | %u | %u | %.2f | %u |\n", family, r.runs, r.changed, r.less, r.twice, r.reach_less,
              r.least < 1e300 ? r.least : 1.0, r.reach_twice);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const figures::Arguments a = figures::ReadArguments(argc, argv);
  const uint64_t to = a.to > 0 ? a.to : 100;
  std::printf(
      "| family | steps | change | volume less | more than twice | reach less | least share | more than twice |\n"
      "|---|---|---|---|---|---|---|---|\n");
  Row all;
  for (const ReportFamily& family : ReportFamilies()) {
    if (!a.Asks(family.name)) continue;
    Row row;
    for (uint64_t seed = a.from; seed <= to; ++seed) {
      const ReportTrial t = PlayReport(family, seed);
      if (!t.IsJudged()) continue;
      row += RowOf(t);
      if (!t.IsAtFault()) continue;
      if (a.reasons)
        std::fprintf(stderr, "%s %llu: %s\n", family.name.c_str(), static_cast<unsigned long long>(seed),
                     t.Text().c_str());
      figures::WriteMeshes(a, family.name, seed,
                           {{"-before", t.step.before}, {"-moved", t.step.moved}, {"-result", t.step.result}});
    }
    Print(family.name.c_str(), row);
    all += row;
  }
  Print("all", all);
  return all.less == 0 ? 0 : 1;
}
