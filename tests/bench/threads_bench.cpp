// SPDX-License-Identifier: MIT
// threads_bench: complete detection on one thread and on several, on the same meshes; the pairs must be the same bits.
// Then steps of 100 pairs of spheres: all vertices move, and either nothing meets, or all pairs do, 100 islands. The
// results must have the same digest.
//
//   threads_bench [--threads N] [--most VERTICES] [--runs N]
//
// The scheduler is that of examples/pool.c.
// Times are those of the clock on the wall, the least of all runs, which take turns: on a busy machine many are needed
// before two threads have had two processors once. The threads are awake, as in a program that uses them all the time:
// the host of a virtual machine may take a millisecond to wake one.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "many_pairs.h"
#include "pool.h"

namespace {

using namespace bench;

double OnTheWall() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Runs {
  double best = 1e30;
  std::vector<tpa_contact> pairs;
};

// All threads of the pool wait for each other.
void Meet(const tpa_exec& exec, int threads) {
  std::atomic<int> missing = threads;
  const auto come = [](void* data, uint32_t) {
    auto& others = *static_cast<std::atomic<int>*>(data);
    --others;
    while (others > 0) continue;
  };
  exec.parallel_for(exec.user, static_cast<uint32_t>(threads), come, &missing);
}

// Whether the library did it. Without a scheduler one thread does all.
bool Run(const Arena& arena, const tpa_mesh_input& input, const tpa_exec* exec, int threads, Runs& runs) {
  tpa_contacts contacts{};
  contacts.struct_size = sizeof contacts;
  // Loaded anew: nothing is known from the run before.
  if (tpa_load(arena.context, &input, nullptr) != TPA_OK) return false;
  if (exec != nullptr) Meet(*exec, threads);
  const double start = OnTheWall();
  if (tpa_detect(arena.context, exec, &contacts, nullptr) != TPA_OK) return false;
  runs.best = std::min(runs.best, OnTheWall() - start);
  runs.pairs.assign(contacts.pairs, contacts.pairs + contacts.count);
  return true;
}

bool Same(const std::vector<tpa_contact>& a, const std::vector<tpa_contact>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(tpa_contact)) == 0;
}

bool Compare(const NamedMesh& named, int threads, int runs) {
  tpa_config config = ConfigFor(named.mesh);
  config.max_contacts = TriangleCount(named.mesh);
  const Arena arena(config);
  if (arena.context == nullptr) return false;
  const tpa_mesh_input input = InputOf(named.mesh);
  Pool* const pool = pool_start(threads);
  if (pool == nullptr) return false;
  const tpa_exec exec = pool_exec(pool);
  Runs one, many;
  bool same = true;
  for (int i = 0; i < runs; ++i)
    same = Run(arena, input, nullptr, 1, one) && Run(arena, input, &exec, threads, many) &&
           Same(one.pairs, many.pairs) && same;
  pool_stop(pool);
  std::printf("%-20s %9u %9.1f %9.1f %7.2f  %s\n", named.name.c_str(), TriangleCount(named.mesh), 1e3 * one.best,
              1e3 * many.best, one.best / many.best, same ? "equal" : "DIFFERENT");
  std::fflush(stdout);
  return same;
}

// ---------------------------------------------------------------- steps

struct Steps {
  double best = 1e30;
  uint64_t digest = 0;
  uint32_t groups = 0;
};

// A step of all vertices, of a mesh without contacts. The detection before tells the library so.
void RunStep(const Arena& arena, const ManyPairs& s, double way, const tpa_exec* exec, int threads, Steps& steps) {
  tpa_issue issue{};
  const tpa_mesh_input input = InputOf(s.mesh);
  Check(tpa_load(arena.context, &input, &issue), "tpa_load", issue);
  tpa_contacts contacts{};
  contacts.struct_size = sizeof contacts;
  Check(tpa_detect(arena.context, nullptr, &contacts, &issue), "tpa_detect", issue);
  MoveTo(arena, Towards(s, way));
  tpa_report report{};
  report.struct_size = sizeof report;
  if (exec != nullptr) Meet(*exec, threads);
  const double start = OnTheWall();
  Check(tpa_step(arena.context, exec, &report, &issue), "tpa_step", issue);
  steps.best = std::min(steps.best, OnTheWall() - start);
  steps.groups = report.groups;
  Check(tpa_digest(arena.context, &steps.digest), "tpa_digest", issue);
}

bool CompareSteps(const ManyPairs& s, double way, int threads, int runs) {
  tpa_config config = ConfigFor(s.mesh);
  config.max_vertices *= 2;
  // Epochs are part of a digest, so both go through the same calls.
  const Arena of_one(config), of_many(config);
  Pool* const pool = pool_start(threads);
  if (of_one.context == nullptr || of_many.context == nullptr || pool == nullptr) return false;
  const tpa_exec exec = pool_exec(pool);
  Steps one, many;
  bool same = true;
  for (int i = 0; i < runs; ++i) {
    RunStep(of_one, s, way, nullptr, 1, one);
    RunStep(of_many, s, way, &exec, threads, many);
    same = same && one.digest == many.digest;
  }
  pool_stop(pool);
  std::printf("step, %3u groups      %9u %9.1f %9.1f %7.2f  %s\n", one.groups, TriangleCount(s.mesh), 1e3 * one.best,
              1e3 * many.best, one.best / many.best, same ? "equal" : "DIFFERENT");
  std::fflush(stdout);
  return same;
}

}  // namespace

int main(int argc, char** argv) {
  int threads = 2, runs = 20;
  uint32_t most = 1400000;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view arg = argv[i];
    if (arg == "--threads" && i + 1 < argc) {
      threads = std::max(1, std::atoi(argv[i + 1]));
    } else if (arg == "--most" && i + 1 < argc) {
      most = static_cast<uint32_t>(std::atof(argv[i + 1]));
    } else if (arg == "--runs" && i + 1 < argc) {
      runs = std::max(1, std::atoi(argv[i + 1]));
    } else {
      std::fprintf(stderr, "usage: threads_bench [--threads N] [--most VERTICES] [--runs N]\n");
      return 2;
    }
  }
  constexpr uint32_t least = 160000;  // vertices
  std::printf("%-20s %9s %9s %7d th. %7s\n", "mesh", "triangles", "1 th. ms", threads, "gain");
  bool same = true;
  for (const NamedMesh& named : StandardMeshes(most))
    if (VertexCount(named.mesh) >= least) same = Compare(named, threads, runs) && same;
  for (const uint32_t vertices : {30000u, 157200u}) {
    const ManyPairs pairs = MakePairs(vertices, 100);
    for (const double way : {0.1, way_to_meet}) same = CompareSteps(pairs, way, threads, runs) && same;
  }
  return same ? 0 : 1;
}
