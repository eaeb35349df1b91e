// SPDX-License-Identifier: MIT
// vertex_hash_bench: nanoseconds per vertex of the vertex hash (TPA_DETECT_VERTEX_HASH) on a sphere whose edges are as
// long as a cell, as in section 3; and of reading all positions once, which is the least that the machine needs.
#include <benchmark/benchmark.h>

#include <cmath>

#include "arena.h"

namespace {

using namespace bench;

// Edges of length 1.
Mesh VoxelSphere(int levels) {
  const double edge = 1.2 / std::pow(2, levels);
  Mesh m = Icosphere(levels, 1 / edge, 0);
  return m;
}

void PerVertex(benchmark::State& state, uint32_t vertices) {
  state.counters["ns_per_vertex"] =
      benchmark::Counter(1e-9 * vertices, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void VertexHash(benchmark::State& state) {
  const Mesh mesh = VoxelSphere(static_cast<int>(state.range(0)));
  tpa_config config = ConfigFor(mesh);
  config.detect_mode = TPA_DETECT_VERTEX_HASH;
  const Arena arena(config);
  tpa_context* const context = arena.context;
  const tpa_mesh_input input = InputOf(mesh);
  if (tpa_load(context, &input, nullptr) != TPA_OK) state.SkipWithError("tpa_load");
  tpa_contacts contacts{};
  contacts.struct_size = sizeof contacts;
  for (auto unused : state)
    if (tpa_detect(context, nullptr, &contacts, nullptr) != TPA_OK) state.SkipWithError("tpa_detect");
  PerVertex(state, VertexCount(mesh));
}
BENCHMARK(VertexHash)->DenseRange(5, 8)->Unit(benchmark::kMicrosecond);

void ReadPositions(benchmark::State& state) {
  const Mesh mesh = VoxelSphere(static_cast<int>(state.range(0)));
  for (auto unused : state) {
    double sum = 0;
    for (double x : mesh.positions) sum += x;
    benchmark::DoNotOptimize(sum);
  }
  PerVertex(state, VertexCount(mesh));
}
BENCHMARK(ReadPositions)->DenseRange(5, 8)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
