// SPDX-License-Identifier: MIT
// locality_figures: scenes beside bodies that they do not meet; a line of a Markdown table for each family of scenes,
// with the number of seeds whose near part differs from the scene alone, for each kind of bodies: in mesh, origins,
// events or vertices held back, and after a plus sign, in the report alone. Arguments:
// bench/figures/seed_table.h; without seeds 1 .. 167 of each family, some 2,000 scenes. --reasons tells each difference
// on stderr, --write writes meshes. Exit 1 where anything differs.
#include <cstdio>
#include <map>

#include "bench/figures/seed_table.h"
#include "support/locality_trial.h"

namespace {

using namespace support;

using Counts = std::map<std::string, uint32_t>;

struct Row {
  uint32_t scenes = 0, meet = 0, differ = 0;
  Counts by_kind, of_report;
  void operator+=(const Row& o) {
    scenes += o.scenes, meet += o.meet, differ += o.differ;
    for (const auto& [kind, count] : o.by_kind) by_kind[kind] += count;
    for (const auto& [kind, count] : o.of_report) of_report[kind] += count;
  }
};

void Tell(const figures::Arguments& a, const std::string& family, uint64_t seed, const LocalityTrial& t) {
  for (const auto& d : t.differences) {
    if (a.reasons)
      std::fprintf(stderr, "%s %llu beside %s: %s\n", family.c_str(), static_cast<unsigned long long>(seed),
                   d.kind.c_str(), d.what.c_str());
    figures::WriteMeshes(a, family, seed,
                         {{"", t.scene.mesh},
                          {"-moved", {t.scene.targets, t.scene.mesh.triangles}},
                          {"-alone", d.alone},
                          {"-" + d.kind, d.beside}});
  }
}

void Print(const char* family, const Row& row) {
  std::printf("| %s | %u | %u | %u |", family, row.scenes, row.meet, row.differ);
  const auto of = [](const Counts& counts, const std::string& kind) {
    const auto found = counts.find(kind);
    return found == counts.end() ? 0 : found->second;
  };
  for (const BesideKind& kind : BesideKinds())
    std::printf(" %u+%u |", of(row.by_kind, kind.name), of(row.of_report, kind.name));
  std::printf("\n");
  std::fflush(stdout);
}

void PrintHead() {
  std::printf("| family | scenes | meet | differ |");
  for (const BesideKind& kind : BesideKinds()) std::printf(" %s |", kind.name.c_str());
  std::printf("\n|---|---|---|---|");
  for (size_t i = 0; i < BesideKinds().size(); ++i) std::printf("---|");
  std::printf("\n");
}

}  // namespace

int main(int argc, char** argv) {
  const figures::Arguments a = figures::ReadArguments(argc, argv);
  const uint64_t to = a.to > 0 ? a.to : 167;
  PrintHead();
  Row all;
  for (const NearFamily& family : NearFamilies()) {
    if (!a.Asks(family.name)) continue;
    Row row;
    for (uint64_t seed = a.from; seed <= to; ++seed) {
      const LocalityTrial t = PlayLocality(family, seed, BesideKinds().size());
      Tell(a, family.name, seed, t);
      ++row.scenes;
      row.meet += t.meets;
      row.differ += !t.differences.empty();
      for (const auto& d : t.differences) ++(d.IsOfReport() ? row.of_report : row.by_kind)[d.kind];
    }
    Print(family.name.c_str(), row);
    all += row;
  }
  Print("all", all);
  return all.differ == 0 ? 0 : 1;
}
