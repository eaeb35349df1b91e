// SPDX-License-Identifier: MIT
// resolve_figures: tpa_adapt on families of tangled meshes, one line of a Markdown table for each. The same
// numbers on every run, but for times. Exit 1 where a mesh came out wrong, 2 where there is none.
//
//   resolve_figures [--count N] [--failures] [FAMILY ...]
//   resolve_figures --mesh FAMILY SEED IN.ply OUT.ply
//
// N meshes of each family, seeds 1 .. N (default: as many as the full run has). --failures names the seeds
// that came out wrong, and how, on stderr. --mesh writes one mesh before and after.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "support/resolve_trial.h"

namespace {

using namespace support;

struct Arguments {
  uint32_t count = 0;
  bool failures = false;
  std::vector<std::string> families;
};

struct Row {
  uint32_t meshes = 0, clean = 0, right = 0, wrong = 0, not_judged = 0, layered = 0, far_off = 0, unresolved = 0;
  std::vector<double> errors, differences;
  double seconds = 0;
};

bool IsWrong(const Family& family, const ResolveTrial& t) {
  return !t.Clean() || t.topology == Verdict::wrong || !t.winding_is_plain || t.volume_error > family.volume_tolerance;
}

void Describe(const Family& family, uint64_t seed, const ResolveTrial& t) {
  std::fprintf(stderr, "%s %llu:", family.name, static_cast<unsigned long long>(seed));
  if (t.status != TPA_OK) std::fprintf(stderr, " %s;", Text(t.issue).c_str());
  if (!t.defect.empty()) std::fprintf(stderr, " %s;", t.defect.c_str());
  if (t.meeting > 0) std::fprintf(stderr, " %zu pairs meet, %u unresolved;", t.meeting, t.report.unresolved);
  if (t.topology == Verdict::wrong) std::fprintf(stderr, " %s instead of %s;", t.found.c_str(), t.expected.c_str());
  if (!t.winding_is_plain) std::fprintf(stderr, " winding numbers beyond 0 and 1;");
  std::fprintf(stderr, " volume error %.4f, passes %u, contacts %u, %.2f s\n", t.volume_error, t.report.passes,
               t.report.contacts, t.seconds);
}

Row RunFamily(const Family& family, const Arguments& arguments) {
  Row row;
  row.meshes = arguments.count > 0 ? std::min(arguments.count, family.count) : family.count;
  for (uint64_t seed = 1; seed <= row.meshes; ++seed) {
    const Tangle tangle = MakeTangle(family, seed);
    if (tangle.mesh.triangles.empty()) return {};  // no real meshes here
    const ResolveTrial t = TryToResolve(family, tangle);
    row.clean += t.Clean() ? 1u : 0u;
    row.right += t.topology == Verdict::right ? 1u : 0u;
    row.wrong += t.topology == Verdict::wrong ? 1u : 0u;
    row.not_judged += t.topology == Verdict::not_judged ? 1u : 0u;
    row.layered += t.winding_is_plain ? 0u : 1u;
    row.far_off += t.volume_error > family.volume_tolerance ? 1u : 0u;
    row.unresolved += t.report.unresolved;
    row.errors.push_back(t.volume_error);
    row.differences.push_back(t.difference);
    row.seconds = std::max(row.seconds, t.seconds);
    if (arguments.failures && IsWrong(family, t)) Describe(family, seed, t);
  }
  for (auto* values : {&row.errors, &row.differences}) std::sort(values->begin(), values->end());
  return row;
}

bool RunAll(const Arguments& arguments) {
  std::printf(
      "| family | meshes | clean | topology right | wrong | not judged | with layers left | volume error "
      "median | most "
      "| beyond tolerance | difference median | most | unresolved pairs | longest s |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  bool right = true;
  for (const Family& family : TangleFamilies()) {
    if (!arguments.families.empty() &&
        std::find(arguments.families.begin(), arguments.families.end(), family.name) == arguments.families.end())
      continue;
    const Row r = RunFamily(family, arguments);
    if (r.meshes == 0) continue;
    std::printf("| %s | %u | %u | %u | %u | %u | %u | %.4f | %.4f | %u | %.4f | %.4f | %u | %.2f |\n", family.name,
                r.meshes, r.clean, r.right, r.wrong, r.not_judged, r.layered, r.errors[r.errors.size() / 2],
                r.errors.back(), r.far_off, r.differences[r.differences.size() / 2], r.differences.back(), r.unresolved,
                r.seconds);
    std::fflush(stdout);
    right = right && r.clean == r.meshes && r.wrong == 0 && r.layered == 0 && r.far_off == 0;
  }
  return right;
}

int WriteOne(char** argv) {
  const Family& family = TangleFamily(argv[0]);
  const Tangle tangle = MakeTangle(family, std::strtoull(argv[1], nullptr, 10));
  if (tangle.mesh.triangles.empty()) {
    std::fprintf(stderr,
                 "resolve_figures: %s is made of real meshes, and there are none in " TOPOADAPT_SHARED_DATA "\n",
                 family.name);
    return 2;
  }
  const ResolveTrial trial = TryToResolve(family, tangle);
  Describe(family, std::strtoull(argv[1], nullptr, 10), trial);
  std::printf("%s\noracle: %s\n", trial.found.c_str(), trial.oracle.c_str());
  const bool written = tool::write_mesh(argv[2], tangle.mesh) && tool::write_mesh(argv[3], trial.result);
  return written && !IsWrong(family, trial) ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 6 && std::strcmp(argv[1], "--mesh") == 0) return WriteOne(argv + 2);
  Arguments arguments;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--failures") == 0)
      arguments.failures = true;
    else if (std::strcmp(argv[i], "--count") == 0 && i + 1 < argc)
      arguments.count = static_cast<uint32_t>(std::strtoul(argv[++i], nullptr, 10));
    else
      arguments.families.push_back(argv[i]);
  }
  return RunAll(arguments) ? 0 : 1;
}
