// SPDX-License-Identifier: MIT
// thread_shares: a step and a sweep of remeshing, to be measured by callgrind: how many instructions run in chunks that
// threads may share. 50 pairs of spheres meet in one step of all vertices: 50 groups. Then one sweep to .9 edges. Tasks
// are called in order by in_order(), in the call of that name; the other one has no tpa_exec.
//
//   thread_shares step|sweep [VERTICES]
//
//   valgrind --tool=callgrind --toggle-collect=tpa_step [--toggle-collect=in_order] thread_shares step 78600
//
// counts a step; with the second option, the part on one thread.
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "many_pairs.h"

extern "C" [[gnu::noinline]] void in_order(void*, uint32_t count, void (*task)(void*, uint32_t), void* data) {
  for (uint32_t i = 0; i < count; ++i) task(data, i);
}

namespace {

using namespace bench;

constexpr int pairs = 50;

void Step(const Arena& arena, const ManyPairs& s, const tpa_exec* exec) {
  tpa_issue issue{};
  MoveTo(arena, Towards(s, way_to_meet));
  tpa_report report{};
  report.struct_size = sizeof report;
  Check(tpa_step(arena.context, exec, &report, &issue), "tpa_step", issue);
  std::printf("step: %u groups, %u contacts, %u handles, %u passes\n", report.groups, report.contacts,
              report.handles[0], report.passes);
}

void Sweep(const Arena& arena, const ManyPairs& s, const tpa_exec* exec) {
  tpa_issue issue{};
  tpa_remesh_options options{};
  options.struct_size = sizeof options;
  options.iterations = 1;
  options.target_length = 0.9 * s.edge;
  options.relaxation = 0.5;
  tpa_report report{};
  report.struct_size = sizeof report;
  Check(tpa_remesh(arena.context, &options, exec, &report, &issue), "tpa_remesh", issue);
  std::printf("sweep: %u splits, %u collapses, %u flips\n", report.splits, report.collapses, report.flips);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view call = argc > 1 ? argv[1] : "";
  if (call != "step" && call != "sweep") {
    std::fprintf(stderr, "usage: thread_shares step|sweep [VERTICES]\n");
    return 2;
  }
  const ManyPairs s = MakePairs(argc > 2 ? static_cast<uint32_t>(std::atoi(argv[2])) : 78600, pairs);
  tpa_config config = ConfigFor(s.mesh);
  config.max_vertices *= 2;
  const Arena arena(config);
  tpa_issue issue = arena.issue;
  if (arena.context == nullptr) Fail("tpa_init", issue);
  const tpa_mesh_input input = InputOf(s.mesh);
  Check(tpa_load(arena.context, &input, &issue), "tpa_load", issue);
  tpa_contacts contacts{};
  contacts.struct_size = sizeof contacts;
  Check(tpa_detect(arena.context, nullptr, &contacts, &issue), "tpa_detect", issue);
  tpa_exec exec{};
  exec.struct_size = sizeof exec;
  exec.parallel_for = in_order;
  std::printf("%u vertices\n", VertexCount(s.mesh));
  Step(arena, s, call == "step" ? &exec : nullptr);
  Sweep(arena, s, call == "sweep" ? &exec : nullptr);
}
