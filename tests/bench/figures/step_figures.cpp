// SPDX-License-Identifier: MIT
// step_figures: tpa_step on families of noise, of uneven bodies and of springs, one line of a Markdown table for each.
// The same on every run, but for times. Exit 1 where a run came out wrong. Arguments: bench/figures/seed_table.h.
// --write writes the step at fault: the mesh before, the mesh of targets (rolled back vertices at their old places),
// the result.
#include <cstdio>

#include "bench/figures/seed_table.h"
#include "support/step_noise.h"

namespace {

using namespace support;

figures::Result Play(const StepFamily& family, uint64_t seed) {
  const StepTrial t = family.play(seed);
  return {t.outcome,     t.reason,
          t.seconds,     VertexCount(t.before),
          t.rolled_back, {{"-before", t.before}, {"-moved", t.moved}, {"-result", t.result}}};
}

}  // namespace

int main(int argc, char** argv) {
  const figures::Arguments a = figures::ReadArguments(argc, argv);
  if (a.list) {
    for (const StepFamily& f : StepFamilies()) std::printf("%-40s %u\n", f.name.c_str(), f.count);
    return 0;
  }
  figures::SeedTable table(a, "mean share rolled back");
  for (const StepFamily& f : StepFamilies())
    if (a.Asks(f.name)) table.Run(f.name, f.count, [&](uint64_t seed) { return Play(f, seed); });
  return table.End() ? 0 : 1;
}
