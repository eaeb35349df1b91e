// SPDX-License-Identifier: MIT
// fuzz_events: work and time of the calls that the fuzzing target `scene` makes: crumpled spheres are untangled by
// tpa_adapt, and moved about by tpa_step. Quantiles, and the seed of the worst call.
//
//   fuzz_events [SCENES [FIRST_SEED]]     (300, 1)
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <tuple>
#include <vector>

#include "crumpled_spheres.h"
#include "quantile.h"
#include "random_bytes.h"
#include "stepping.h"

namespace {

struct Calls {
  const char* name;
  std::vector<double> units, seconds;
  uint64_t refused = 0, worst_seed = 0;
  double worst = 0;
};

// Limits that suffice for nearly all scenes; the target's own are often too small on purpose.
constexpr uint32_t most_vertices = 32768;

// A call with a tpa_exec. True for TPA_OK.
template <class Call>
bool Measure(Calls& calls, uint64_t seed, const Call& call) {
  uint64_t units = 0;
  tpa_exec exec{};
  exec.struct_size = sizeof exec;
  exec.progress = &units;
  const double start = bench::Now();
  const tpa_status status = call(&exec);
  const double seconds = bench::Now() - start;
  if (status != TPA_OK) ++calls.refused;
  calls.units.push_back(static_cast<double>(units));
  calls.seconds.push_back(seconds);
  if (seconds > calls.worst) {
    calls.worst = seconds;
    calls.worst_seed = seed;
  }
  return status == TPA_OK;
}

void MoveAll(tpa_context* context, const std::vector<double>& targets) {
  tpa_move_input move{};
  move.struct_size = sizeof move;
  move.count = static_cast<uint32_t>(targets.size() / 3);
  move.position_type = TPA_FLOAT64;
  move.positions = targets.data();
  tpa_issue issue;
  bench::Check(tpa_move(context, &move, &issue), "tpa_move", issue);
}

void Play(uint64_t seed, Calls& adapt, Calls& step) {
  const std::vector<uint8_t> bytes = fuzz::RandomBytes(seed);
  fuzz::Bytes in{bytes.data(), bytes.size()};
  tpa_config config = fuzz::CrumpledConfig(in);
  tpa_config_init(&config, sizeof config);
  config.max_vertices = most_vertices;
  const tool::TriangleMesh scene = fuzz::CrumpledSpheres(in);
  tpa_arena_size size;
  tpa_issue issue;
  bench::Check(tpa_arena_query(&config, &size, &issue), "tpa_arena_query", issue);
  const std::unique_ptr<void, decltype(&std::free)> block(std::malloc(size.bytes), std::free);
  tpa_context* context = nullptr;
  bench::Check(tpa_init(block.get(), size.bytes, &config, &context, &issue), "tpa_init", issue);
  tpa_mesh_input mesh{};
  mesh.struct_size = sizeof mesh;
  mesh.vertex_count = static_cast<uint32_t>(scene.positions.size() / 3);
  mesh.triangle_count = static_cast<uint32_t>(scene.triangles.size() / 3);
  mesh.position_type = TPA_FLOAT64;
  mesh.index_type = TPA_UINT32;
  mesh.positions = scene.positions.data();
  mesh.triangles = scene.triangles.data();
  if (tpa_load(context, &mesh, &issue) != TPA_OK) return;
  tpa_report report{};
  report.struct_size = sizeof report;
  const bool untangled =
      Measure(adapt, seed, [&](const tpa_exec* exec) { return tpa_adapt(context, exec, &report, &issue); });
  if (!untangled || report.unresolved > 0) return;
  for (int i = 0; i < 3; ++i) {
    const tpa_mesh_view view = bench::ViewOf(context);
    std::vector<double> targets(view.positions, view.positions + 3 * size_t{view.vertex_count});
    fuzz::MoveAbout(in, targets);
    MoveAll(context, targets);
    Measure(step, seed, [&](const tpa_exec* exec) { return tpa_step(context, exec, &report, &issue); });
  }
}

void Print(const Calls& calls) {
  for (const auto& [what, values, scale] :
       {std::tuple{"units / 1000", &calls.units, 1e-3}, std::tuple{"milliseconds", &calls.seconds, 1e3}}) {
    std::printf("%-10s %-13s %7zu %8llu", calls.name, what, values->size(),
                static_cast<unsigned long long>(calls.refused));
    for (const double share : {.5, .99, .999, 1.}) std::printf(" %10.3f", scale * bench::Quantile(*values, share));
    std::printf(" %10llu\n", static_cast<unsigned long long>(calls.worst_seed));
  }
}

}  // namespace

int main(int argc, char** argv) {
  const uint64_t scenes = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 300;
  const uint64_t first = argc > 2 ? std::strtoull(argv[2], nullptr, 10) : 1;
  Calls adapt{"tpa_adapt", {}, {}}, step{"tpa_step", {}, {}};
  for (uint64_t seed = first; seed < first + scenes; ++seed) Play(seed, adapt, step);
  std::printf("%-10s %-13s %7s %8s %10s %10s %10s %10s %10s\n", "call", "", "calls", "refused", "median", "99 %",
              "99.9 %", "worst", "worst seed");
  Print(adapt);
  Print(step);
  return 0;
}
