// SPDX-License-Identifier: MIT
// region_figures: tpa_adapt on families of field meshes, one line of a Markdown table for each. The same on every run,
// but for times. Exit 1 where a mesh came out wrong. Arguments: bench/figures/seed_table.h. --write writes the mesh as
// FAMILY-SEED.off and its result as FAMILY-SEED-result.off.
#include <cstdio>

#include "bench/figures/seed_table.h"

namespace {

using namespace support;

figures::Result Play(const FieldFamily& family, uint64_t seed) {
  const Mesh given = MakeFieldMesh(family, seed);
  if (given.triangles.empty()) return {};  // no files here
  const RegionTrial t = TryRegion(family, given, seed);
  return {t.verdict.outcome,
          t.verdict.reason,
          t.seconds,
          VertexCount(given),
          t.verdict.topology_judged ? 1.0 : 0.0,
          {{"", given}, {"-result", t.result}}};
}

}  // namespace

int main(int argc, char** argv) {
  const figures::Arguments a = figures::ReadArguments(argc, argv);
  if (a.list) {
    for (const FieldFamily& f : FieldFamilies()) std::printf("%-28s %u\n", f.name.c_str(), f.count);
    return 0;
  }
  figures::SeedTable table(a, "share with topology judged");
  for (const FieldFamily& f : FieldFamilies())
    if (a.Asks(f.name)) table.Run(f.name, f.count, [&](uint64_t seed) { return Play(f, seed); });
  return table.End() ? 0 : 1;
}
