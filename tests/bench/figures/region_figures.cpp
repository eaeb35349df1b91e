// SPDX-License-Identifier: MIT
// region_figures: tpa_adapt on families of field meshes, one line of a Markdown table for each, with the seeds that
// came out wrong or were refused. The same on every run, but for times. Exit 1 where a mesh came out wrong.
//
//   region_figures [--write DIR] [--list] [--reasons] [FAMILY [FROM TO]]
//
// Seeds FROM .. TO of a family (default: all that the long run has), or of all families. A FAMILY that ends in * means
// all families that begin so. --reasons tells why, on stderr. --write puts each wrong or refused mesh and its result
// into a folder, as FAMILY-SEED.off and FAMILY-SEED-result.off.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "support/region_trial.h"

namespace {

using namespace support;

struct Arguments {
  std::string family = "*", folder;
  uint64_t from = 1, to = 0;
  bool list = false, reasons = false;
};

struct Row {
  uint32_t meshes = 0, right = 0, judged = 0, most_vertices = 0;
  std::string refused, wrong;  // seeds
  uint32_t refused_count = 0, wrong_count = 0;
  std::vector<double> seconds;
};

bool IsAsked(const FieldFamily& f, const Arguments& a) {
  if (a.family.back() != '*') return f.name == a.family;
  return f.name.compare(0, a.family.size() - 1, a.family, 0, a.family.size() - 1) == 0;
}

void Write(const Arguments& a, const FieldFamily& f, uint64_t seed, const Mesh& given, const Mesh& result) {
  std::filesystem::create_directories(a.folder);
  const std::string path = a.folder + "/" + f.name + "-" + std::to_string(seed);
  for (const auto& [name, mesh] : {std::pair{path + ".off", &given}, std::pair{path + "-result.off", &result}}) {
    if (mesh->triangles.empty()) continue;
    const tool::Status s = tool::write_mesh(name, *mesh);
    if (!s) std::fprintf(stderr, "region_figures: %s\n", s.message.c_str());
  }
}

void RunSeed(const Arguments& a, const FieldFamily& f, uint64_t seed, Row& row) {
  const Mesh given = MakeFieldMesh(f, seed);
  if (given.triangles.empty()) return;  // no files here
  const RegionTrial t = TryRegion(f, given, seed);
  ++row.meshes;
  row.most_vertices = std::max(row.most_vertices, VertexCount(given));
  row.seconds.push_back(t.seconds);
  row.judged += t.verdict.topology_judged ? 1u : 0u;
  if (t.verdict.outcome == Outcome::right) {
    ++row.right;
    return;
  }
  const bool is_wrong = t.verdict.outcome == Outcome::wrong;
  ++(is_wrong ? row.wrong_count : row.refused_count);
  (is_wrong ? row.wrong : row.refused) += " " + std::to_string(seed);
  if (a.reasons)
    std::fprintf(stderr, "%s %llu: %s: %s; %u triangles, %.3f s\n", f.name.c_str(),
                 static_cast<unsigned long long>(seed), is_wrong ? "wrong" : "refused", t.verdict.reason.c_str(),
                 TriangleCount(given), t.seconds);
  if (!a.folder.empty()) Write(a, f, seed, given, t.result);
}

// The first few seeds.
std::string Some(const std::string& seeds) {
  if (seeds.size() < 60) return seeds;
  return seeds.substr(0, seeds.rfind(' ', 60)) + " ...";
}

bool RunAll(const Arguments& a) {
  std::printf(
      "| family | meshes | right | topology judged | refused | wrong | median s | most s | most vertices | seeds |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n");
  uint32_t meshes = 0, right = 0, refused = 0, wrong = 0;
  for (const FieldFamily& f : FieldFamilies()) {
    if (!IsAsked(f, a)) continue;
    Row row;
    const uint64_t to = a.to > 0 ? a.to : f.count;
    for (uint64_t seed = a.from; seed <= to; ++seed) RunSeed(a, f, seed, row);
    if (row.meshes == 0) continue;
    std::sort(row.seconds.begin(), row.seconds.end());
    std::printf("| %s | %u | %u | %u | %u | %u | %.4f | %.3f | %u |%s%s%s%s |\n", f.name.c_str(), row.meshes, row.right,
                row.judged, row.refused_count, row.wrong_count, row.seconds[row.seconds.size() / 2], row.seconds.back(),
                row.most_vertices, row.wrong_count > 0 ? " wrong" : "", Some(row.wrong).c_str(),
                row.refused_count > 0 ? " refused" : "", Some(row.refused).c_str());
    std::fflush(stdout);
    meshes += row.meshes, right += row.right, refused += row.refused_count, wrong += row.wrong_count;
  }
  std::printf("| all | %u | %u | | %u | %u | | | | |\n", meshes, right, refused, wrong);
  return wrong == 0;
}

void List() {
  for (const FieldFamily& f : FieldFamilies()) std::printf("%-28s %u\n", f.name.c_str(), f.count);
}

}  // namespace

int main(int argc, char** argv) {
  Arguments a;
  std::vector<std::string> words;
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], "--list") == 0)
      a.list = true;
    else if (std::strcmp(argv[i], "--reasons") == 0)
      a.reasons = true;
    else if (std::strcmp(argv[i], "--write") == 0 && i + 1 < argc)
      a.folder = argv[++i];
    else
      words.push_back(argv[i]);
  }
  if (a.list) {
    List();
    return 0;
  }
  if (!words.empty() && !words[0].empty()) a.family = words[0];
  if (words.size() > 1) a.from = a.to = std::strtoull(words[1].c_str(), nullptr, 10);
  if (words.size() > 2) a.to = std::strtoull(words[2].c_str(), nullptr, 10);
  return RunAll(a) ? 0 : 1;
}
