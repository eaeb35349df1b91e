// SPDX-License-Identifier: MIT
// cut_bench: the exact cut beside peers that unite, on the meshes from the field and on the families of the tests.
// Milliseconds of processor time and a verdict for each mesh and cutter.
//
//   cut_bench [--shared FOLDER] [--manifold FOLDER] [--seconds LIMIT] [--seeds N] [--only TEXT]
//
// Right is a result that is closed, oriented and manifold, where no triangles meet, and that loses and gains at most 2
// % of the region together, by random columns; the
// number of components follows. --manifold names a folder with node_modules/manifold-3d.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "cutters.h"
#include "detectors.h"
#include "oracle/mesh_oracle.h"
#include "oracle/region_columns.h"
#include "support/field_meshes.h"

namespace {

using namespace bench;

struct Options {
  std::string shared = "../shared", manifold, only;
  int seconds = 60;
  uint64_t seeds = 1;
};

struct Peer {
  const char* name;
  Cutter cutter;  // nullptr: Manifold
};
constexpr Peer peers[] = {{"library", CutWithLibrary},
                          {"autorefine", AutorefineWithCgal},
                          {"corefine", UniteWithCgal},
                          {"manifold", nullptr}};
constexpr size_t peer_count = std::size(peers);

struct Verdict {
  bool is_right = false;
  std::string text;
  double seconds = 0;
};

std::string Format(const char* format, double x) {
  char text[64];
  std::snprintf(text, sizeof text, format, x);
  return text;
}

// Of a finished cut.
Verdict Judge(const Mesh& given, const Cut& cut) {
  Verdict v{false, {}, cut.seconds};
  if (cut.mesh.triangles.empty()) return v.text = "empty", v;
  const support::Topology topology = support::TopologyOf(cut.mesh);
  const support::RegionDifference region = support::CompareRegions(given, cut.mesh, 4000, 1);
  const double error = 100 * (region.Lost() + region.Gained());
  if (error > 2) {
    v.text = Format("%.1f % wrong", error);
  } else if (!topology.defect.empty()) {
    v.text = "not manifold";
  } else if (const size_t pairs = DetectWithCgal(cut.mesh, 1).pairs.size(); pairs > 0) {
    v.text = std::to_string(pairs) + " meet";
  } else {
    v.is_right = true;
    v.text = "right";
  }
  v.text += ", " + std::to_string(topology.components.size());
  return v;
}

Outcome Run(const Peer& peer, const Mesh& mesh, const Options& o) {
  if (peer.cutter != nullptr) return RunInChild(peer.cutter, mesh, o.seconds);
  return RunProgram({"node", BENCH_MANIFOLD_SCRIPT, o.manifold}, mesh, o.seconds);
}

Verdict TryPeer(const Peer& peer, const Mesh& mesh, const Options& o) {
  const Outcome outcome = Run(peer, mesh, o);
  switch (outcome.kind) {
    case Outcome::done: return Judge(mesh, outcome.cut);
    case Outcome::refused: return {false, "refuses", -1};
    case Outcome::crashed: return {false, "crashes", -1};
    case Outcome::late: break;
  }
  return {false, "> " + std::to_string(o.seconds) + " s", -1};
}

bool IsLeftOut(const Peer& peer, const Options& o) { return peer.cutter == nullptr && o.manifold.empty(); }

// Meshes where nothing meets are no task for a cut.
bool IsTask(const Mesh& mesh) { return !mesh.triangles.empty() && !DetectWithCgal(mesh, 1).pairs.empty(); }

void FileRow(const std::string& path, const Options& o) {
  const std::string name = std::filesystem::path(path).stem().string();
  Mesh mesh;
  if (name.find(o.only) == std::string::npos || !tool::read_mesh(path, mesh) || !IsTask(mesh)) return;
  std::printf("%-16s %9u", name.c_str(), TriangleCount(mesh));
  for (const Peer& peer : peers) {
    if (IsLeftOut(peer, o)) continue;
    const Verdict v = TryPeer(peer, mesh, o);
    std::printf(" | %9s %-18s", v.seconds >= 0 ? Format("%.3f", 1e3 * v.seconds).c_str() : "-", v.text.c_str());
    std::fflush(stdout);
  }
  std::printf("\n");
}

// Of some meshes: those that each peer gets right, with its seconds on these, and the library's.
struct Sums {
  uint32_t meshes = 0;
  struct Sum {
    uint32_t right = 0;
    double seconds = 0, ours = 0;
  } of[peer_count];

  void Add(const Sums& other) {
    meshes += other.meshes;
    for (size_t i = 0; i < peer_count; ++i) {
      of[i].right += other.of[i].right;
      of[i].seconds += other.of[i].seconds;
      of[i].ours += other.of[i].ours;
    }
  }
  void Print(const char* name) const {
    std::printf("%-28s %4u", name, meshes);
    for (const Sum& sum : of) std::printf(" | %4u %6.1f", sum.right, sum.ours > 0 ? sum.seconds / sum.ours : 0);
    std::printf("\n");
    std::fflush(stdout);
  }
};

Sums TryAll(const Mesh& mesh, const Options& o) {
  Sums sums{1, {}};
  double ours = 0;
  for (size_t i = 0; i < peer_count; ++i) {
    if (IsLeftOut(peers[i], o)) continue;
    const Verdict v = TryPeer(peers[i], mesh, o);
    if (i == 0) ours = v.seconds;
    if (v.is_right) sums.of[i] = {1, v.seconds, ours};
  }
  return sums;
}

void Families(const Options& o) {
  std::printf("\nmeshes, and for each cutter those right and its time over the library's on these:\n");
  Sums one_body, bodies;
  for (const support::FieldFamily& family : support::FieldFamilies()) {
    if (family.name.find(o.only) == std::string::npos || family.name == "field-files") continue;
    Sums sums;
    for (uint64_t seed = 1; seed <= std::min<uint64_t>(o.seeds, family.count); ++seed) {
      const Mesh mesh = support::MakeFieldMesh(family, seed);
      if (!IsTask(mesh)) continue;
      const Sums tried = TryAll(mesh, o);
      sums.Add(tried);
      (support::TopologyOf(mesh).components.size() > 1 ? bodies : one_body).Add(tried);
    }
    sums.Print(family.name.c_str());
  }
  bodies.Print("all of several bodies");
  one_body.Print("all of one body");
}

std::vector<std::string> FilesOf(const std::string& folder) {
  std::vector<std::string> paths;
  std::error_code absent;
  for (const auto& entry : std::filesystem::directory_iterator(folder, absent)) paths.push_back(entry.path().string());
  if (paths.empty()) std::fprintf(stderr, "no files in %s: those are left out\n", folder.c_str());
  std::sort(paths.begin(), paths.end());
  return paths;
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string_view arg = argv[i];
    if (arg == "--shared") o.shared = argv[i + 1];
    if (arg == "--manifold") o.manifold = argv[i + 1];
    if (arg == "--only") o.only = argv[i + 1];
    if (arg == "--seconds") o.seconds = std::max(1, std::atoi(argv[i + 1]));
    if (arg == "--seeds") o.seeds = static_cast<uint64_t>(std::max(0, std::atoi(argv[i + 1])));
  }
  std::printf("%-16s %9s", "mesh", "triangles");
  for (const Peer& peer : peers)
    if (!IsLeftOut(peer, o)) std::printf(" | %-28s", peer.name);
  std::printf("\n");
  for (const std::string& path : FilesOf(o.shared + "/data/field")) FileRow(path, o);
  Families(o);
}
