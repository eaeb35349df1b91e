// SPDX-License-Identifier: MIT
// coarse_figures: one, three or all vertices of coarse bodies move by up to three edges; a line of a Markdown table for
// each family, judged by columns of rays. Arguments: bench/figures/seed_table.h; without seeds 1 .. 667 of each family,
// some 10,000 runs. --reasons names the seeds at fault on stderr, --write writes their meshes. Exit 1 where a run is at
// fault, over the bound, or told less than was measured.
#include <algorithm>
#include <cstdio>

#include "bench/figures/seed_table.h"
#include "support/coarse_trial.h"

namespace {

using namespace support;

struct Row {
  uint32_t runs = 0, meet = 0, refused = 0, held_back = 0, held_over = 0, over = 0, twentieth = 0, less = 0, faults = 0;
  double worst = 0, held_share = 0, seconds = 0;
  uint64_t worst_seed = 0, slowest = 0;
  void operator+=(const Row& o) {
    runs += o.runs, meet += o.meet, refused += o.refused, held_back += o.held_back, over += o.over;
    held_over += o.held_over;
    twentieth += o.twentieth, less += o.less, faults += o.faults;
    held_share += o.held_share;
    if (o.seconds > seconds) seconds = o.seconds, slowest = o.slowest;
    if (o.worst > worst) worst = o.worst, worst_seed = o.worst_seed;
  }
};

constexpr double large_share = 0.05;

Row RowOf(const CoarseTrial& t, uint64_t seed) {
  Row row;
  row.runs = 1, row.meet = t.meets, row.refused = t.Refuses(), row.held_back = t.HoldsBack(), row.over = t.IsOver();
  row.held_over = t.IsBeyond() && t.HoldsBack(), row.less = t.TellsLess(), row.faults = !t.fault.empty();
  row.held_share = t.held_back, row.seconds = t.step.seconds, row.slowest = seed;
  if (t.IsJudged() && !t.HoldsBack()) {
    row.worst = t.Share(), row.worst_seed = seed;
    row.twentieth = t.Share() > large_share;
  }
  return row;
}

void Print(const char* family, const Row& r) {
  std::printf("| %s | %u | %u | %u | %u | %.2f | %u | %u | %u | %.2f | %llu | %u | %u | %.3f (%llu) |\n", family,
              r.runs, r.meet, r.refused, r.held_back, r.held_back > 0 ? 100 * r.held_share / r.held_back : 0.0,
              r.held_over, r.over, r.twentieth, 100 * r.worst, static_cast<unsigned long long>(r.worst_seed), r.less,
              r.faults, r.seconds, static_cast<unsigned long long>(r.slowest));
  std::fflush(stdout);
}

void Tell(const figures::Arguments& a, const std::string& family, uint64_t seed, const CoarseTrial& t) {
  if (!t.IsOver() && !t.TellsLess() && t.fault.empty() && !t.Refuses()) return;
  if (a.reasons)
    std::fprintf(stderr, "%s %llu: %s%s%s; changed %.5f +- %.5f of %.5f, allowed %.5f, told %.5f, %u contacts; %s\n",
                 family.c_str(), static_cast<unsigned long long>(seed), t.fault.c_str(), t.IsOver() ? "over" : "",
                 t.TellsLess() ? " told less" : "", t.changed, t.error, t.volume, t.allowed, t.told,
                 t.step.report.contacts, t.Refuses() ? Text(t.step.issue).c_str() : "done");
  figures::WriteMeshes(a, family, seed,
                       {{"-before", t.step.before}, {"-moved", t.step.moved}, {"-result", t.step.result}});
}

}  // namespace

int main(int argc, char** argv) {
  const figures::Arguments a = figures::ReadArguments(argc, argv);
  const uint64_t to = a.to > 0 ? a.to : 667;
  std::printf(
      "| family | runs | meet | refused | hold back | of vertices %% | and over | over | over 5 %% | worst %% | seed | "
      "told less "
      "| "
      "faults | most s (seed) |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  Row all;
  for (const CoarseFamily& family : CoarseFamilies()) {
    if (!a.Asks(family.name)) continue;
    Row row;
    for (uint64_t seed = a.from; seed <= to; ++seed) {
      const CoarseTrial t = PlayCoarse(family, seed);
      Tell(a, family.name, seed, t);
      row += RowOf(t, seed);
    }
    Print(family.name.c_str(), row);
    all += row;
  }
  Print("all", all);
  return all.over + all.less + all.faults == 0 ? 0 : 1;
}
