// SPDX-License-Identifier: MIT
// offset_figures: steps up to 1e12 sizes away from the origin; a line of a Markdown table for each family,
// judged by exact predicates of the tests. Arguments: bench/figures/seed_table.h; without seeds 1 .. 2381 of each
// family, in all 100,000 steps. --reasons names the seeds at fault on stderr, --write writes their meshes. Exit 1 where
// a run is at fault.
#include <algorithm>
#include <cstdio>

#include "bench/figures/seed_table.h"
#include "support/offset_trial.h"

namespace {

using namespace support;

struct Row {
  uint32_t runs = 0, tangled = 0, meet = 0, refused = 0, held_back = 0, faults = 0;
  double seconds = 0;
  uint64_t slowest = 0;
  std::string seeds;
  void operator+=(const Row& o) {
    runs += o.runs, tangled += o.tangled, meet += o.meet, refused += o.refused, held_back += o.held_back;
    faults += o.faults;
    if (o.seconds > seconds) seconds = o.seconds, slowest = o.slowest;
    if (seeds.size() < 60) seeds += o.seeds;
  }
};

Row RowOf(const OffsetTrial& t, uint64_t seed) {
  Row row;
  row.runs = 1, row.tangled = !t.starts_clean, row.meet = t.meets, row.refused = t.step.status != TPA_OK;
  row.held_back = t.step.report.rolled_back_vertices > 0, row.faults = !t.fault.empty();
  row.seconds = t.step.seconds, row.slowest = seed;
  if (!t.fault.empty()) row.seeds = " " + std::to_string(seed);
  return row;
}

void Print(const char* family, const Row& r) {
  std::printf("| %s | %u | %u | %u | %u | %u | %u | %.3f (%llu) |%s |\n", family, r.runs, r.meet, r.tangled, r.refused,
              r.held_back, r.faults, r.seconds, static_cast<unsigned long long>(r.slowest), r.seeds.c_str());
  std::fflush(stdout);
}

void Tell(const figures::Arguments& a, const std::string& family, uint64_t seed, const OffsetTrial& t) {
  if (a.reasons && (!t.fault.empty() || t.step.status != TPA_OK))
    std::fprintf(stderr, "%s %llu: %s; %s\n", family.c_str(), static_cast<unsigned long long>(seed),
                 t.fault.empty() ? "refused" : t.fault.c_str(), Text(t.step.issue).c_str());
  if (t.fault.empty()) return;
  figures::WriteMeshes(a, family, seed,
                       {{"-before", t.step.before}, {"-moved", t.step.moved}, {"-result", t.step.result}});
}

}  // namespace

int main(int argc, char** argv) {
  const figures::Arguments a = figures::ReadArguments(argc, argv);
  const uint64_t to = a.to > 0 ? a.to : 2381;
  std::printf(
      "| family | runs | meet | tangled by rounding | refused | hold back | faults | most s (seed) | seeds |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  Row all;
  for (const OffsetFamily& family : OffsetFamilies()) {
    if (!a.Asks(family.name)) continue;
    Row row;
    for (uint64_t seed = a.from; seed <= to; ++seed) {
      const OffsetTrial t = PlayOffset(family, seed);
      Tell(a, family.name, seed, t);
      row += RowOf(t, seed);
    }
    Print(family.name.c_str(), row);
    row.seeds.clear();
    all += row;
  }
  Print("all", all);
  return all.faults == 0 ? 0 : 1;
}
