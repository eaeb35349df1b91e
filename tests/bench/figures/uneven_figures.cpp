// SPDX-License-Identifier: MIT
// uneven_figures: bodies of uneven sampling that grow together, and thin true tunnels beside other contacts; a line of
// a Markdown table for each family. Arguments: bench/figures/seed_table.h; without seeds 1 .. 200 of each pair and
// speed, and 1 .. 17 of each family of tunnels. Seeds are mixed before use. --reasons tells what is wrong on stderr,
// --write writes the steps. Exit 1 where anything is wrong.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "bench/figures/seed_table.h"
#include "support/mixed_seed.h"
#include "support/thin_tunnels.h"
#include "support/uneven_approach.h"

namespace {

using namespace support;

constexpr int columns = 5000;

// Mean, and the worst with its seed.
struct Errors {
  double sum = 0, worst = 0;
  uint64_t seed = 0;
  void Add(double error, uint64_t of) {
    sum += error;
    if (error > worst) worst = error, seed = of;
  }
  void operator+=(const Errors& o) {
    sum += o.sum;
    if (o.worst > worst) worst = o.worst, seed = o.seed;
  }
};

struct PairRow {
  uint32_t runs = 0, met = 0, one = 0, refused = 0, unsound = 0, held_back = 0;
  Errors volume, difference;
  double seconds = 0;
  std::string seeds;
  void operator+=(const PairRow& o) {
    runs += o.runs, met += o.met, one += o.one, refused += o.refused, unsound += o.unsound, held_back += o.held_back;
    volume += o.volume, difference += o.difference;
    seconds = std::max(seconds, o.seconds);
  }
};

void Print(const std::string& family, const PairRow& r) {
  const double met = std::max(1u, r.met);
  std::printf("| %s | %u | %u | %u | %.1f | %u | %u | %u | %.3f | %.2f (%llu) | %.3f | %.2f (%llu) | %.2f |%s |\n",
              family.c_str(), r.runs, r.met, r.one, 100.0 * r.one / std::max(1u, r.runs), r.refused, r.unsound,
              r.held_back, 100 * r.volume.sum / met, 100 * r.volume.worst,
              static_cast<unsigned long long>(r.volume.seed), 100 * r.difference.sum / met, 100 * r.difference.worst,
              static_cast<unsigned long long>(r.difference.seed), r.seconds, r.seeds.c_str());
  std::fflush(stdout);
}

std::string TextOf(const Approached& a) {
  std::string text = a.met ? std::to_string(a.end.components.size()) + " bodies, genera" : "never met";
  for (int64_t g : a.end.Genera()) text += " " + std::to_string(g);
  return a.trial.reason.empty() ? text : a.trial.reason;
}

void AddTo(PairRow& row, const Approached& a, uint64_t seed) {
  ++row.runs;
  row.met += a.met;
  row.refused += a.trial.outcome == Outcome::refused;
  row.unsound += a.trial.outcome == Outcome::wrong;
  row.held_back += a.held_back > 0;
  row.seconds = std::max(row.seconds, a.trial.seconds);
  row.volume.Add(std::fabs(a.volume_error), seed);
  row.difference.Add(a.difference, seed);
  if (a.trial.outcome == Outcome::right && a.met && a.IsOneBody())
    ++row.one;
  else if (row.seeds.size() < 60)
    row.seeds += " " + std::to_string(seed);
}

PairRow PlayPairs(const figures::Arguments& a, const std::string& name, const UnevenPair& pair, double speed) {
  PairRow row;
  for (uint64_t seed = a.from; seed <= (a.to > 0 ? a.to : 200); ++seed) {
    const Approached run = PlayApproach(pair, speed, columns, Soundness::of_first_and_last, MixedSeed(name, seed));
    AddTo(row, run, seed);
    if (run.trial.outcome == Outcome::right && run.met && run.IsOneBody()) continue;
    if (a.reasons)
      std::fprintf(stderr, "%s %llu: %s\n", name.c_str(), static_cast<unsigned long long>(seed), TextOf(run).c_str());
    figures::WriteMeshes(a, name, seed,
                         {{"-before", run.trial.before}, {"-moved", run.trial.moved}, {"-result", run.trial.result}});
  }
  Print(name, row);
  return row;
}

std::string NameOf(const char* title, const UnevenPair& pair, int thousandths) {
  return std::string(title) + "-" + pair.name + "-by-" + std::to_string(thousandths);
}

bool AsksAny(const figures::Arguments& a, const char* title, const std::vector<UnevenPair>& pairs) {
  return std::any_of(pairs.begin(), pairs.end(), [&](const UnevenPair& pair) {
    return std::any_of(std::begin(uneven_thousandths), std::end(uneven_thousandths),
                       [&](int thousandths) { return a.Asks(NameOf(title, pair, thousandths)); });
  });
}

bool AllPairs(const figures::Arguments& a, const char* title, const std::vector<UnevenPair>& pairs) {
  if (!AsksAny(a, title, pairs)) return true;
  std::printf(
      "| %s | runs | met | one body | %% | refused | unsound | event holds back | volume off, mean %% | worst %% "
      "(seed) | difference, mean %% | worst %% (seed) | most s | others |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      title);
  PairRow all;
  for (const UnevenPair& pair : pairs)
    for (const int thousandths : uneven_thousandths) {
      const std::string name = NameOf(title, pair, thousandths);
      if (a.Asks(name)) all += PlayPairs(a, name, pair, 0.001 * thousandths);
    }
  Print("all", all);
  std::printf("\n");
  return all.one == all.runs;
}

struct TunnelRow {
  uint32_t runs = 0, met = 0, closed = 0, refused = 0, unsound = 0;
  std::string seeds;
  void operator+=(const TunnelRow& o) {
    runs += o.runs, met += o.met, closed += o.closed, refused += o.refused, unsound += o.unsound;
  }
};

void Print(const std::string& family, const TunnelRow& r) {
  std::printf("| %s | %u | %u | %u | %u | %u |%s |\n", family.c_str(), r.runs, r.met, r.closed, r.refused, r.unsound,
              r.seeds.c_str());
  std::fflush(stdout);
}

TunnelRow PlayTunnels(const figures::Arguments& a, const TunnelFamily& family) {
  TunnelRow row;
  for (uint64_t seed = a.from; seed <= (a.to > 0 ? a.to : 17); ++seed) {
    const TunnelTrial t = PlayTunnel(family, seed);
    const bool is_right = !t.is_closed && t.trial.outcome == Outcome::right;
    ++row.runs;
    row.met += t.met, row.closed += t.is_closed;
    row.refused += t.trial.outcome == Outcome::refused, row.unsound += t.trial.outcome == Outcome::wrong;
    if (is_right) continue;
    if (row.seeds.size() < 60) row.seeds += " " + std::to_string(seed);
    if (a.reasons)
      std::fprintf(stderr, "%s %llu: %s%s; thickness %.3f edges\n", family.name.c_str(),
                   static_cast<unsigned long long>(seed), t.reason.c_str(), t.trial.reason.c_str(), t.thickness);
    figures::WriteMeshes(a, family.name, seed,
                         {{"-before", t.trial.before}, {"-moved", t.trial.moved}, {"-result", t.trial.result}});
  }
  Print(family.name, row);
  return row;
}

bool AllTunnels(const figures::Arguments& a) {
  const std::vector<TunnelFamily>& families = TunnelFamilies();
  if (std::none_of(families.begin(), families.end(), [&](const TunnelFamily& f) { return a.Asks(f.name); }))
    return true;
  std::printf(
      "| thin | runs | met | closed | refused | unsound | seeds |\n"
      "|---|---|---|---|---|---|---|\n");
  TunnelRow all;
  for (const TunnelFamily& family : families)
    if (a.Asks(family.name)) all += PlayTunnels(a, family);
  Print("all", all);
  return all.closed + all.refused + all.unsound == 0;
}

}  // namespace

int main(int argc, char** argv) {
  const figures::Arguments a = figures::ReadArguments(argc, argv);
  const bool uneven = AllPairs(a, "uneven", UnevenPairs()), harder = AllPairs(a, "harder", HarderPairs());
  const bool tunnels = AllTunnels(a);
  return uneven && harder && tunnels ? 0 : 1;
}
