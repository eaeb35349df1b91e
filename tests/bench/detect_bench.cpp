// SPDX-License-Identifier: MIT
// detect_bench: the library and its peers on the same meshes in the same run. Prints nanoseconds per triangle and how
// many times faster the library is than the fastest peer. Exit 1 where the pairs differ.
//
//   detect_bench [--most VERTICES] [--repeats N] [--only TEXT] [--alone] [MESH...]
//
// The least time of all runs counts. Detectors take turns, half of their runs each where these are four or more, so
// that none has the better hour of a machine that others use as well.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string_view>

#include "detectors.h"

namespace {

using namespace bench;

// The library, then its peers.
constexpr Detector detectors[] = {
    {"ours", DetectOurs},
#ifdef BENCH_CGAL
    {"CGAL", DetectWithCgal},
#endif
#ifdef BENCH_EMBREE
    {"Embree", DetectWithEmbree},
#endif
};

struct Options {
  uint32_t most = 400000;  // vertices of a mesh
  int repeats = 4;
  std::string only;
  bool alone = false;  // without the peers
  std::vector<std::string> files;
};

Options Read(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string_view arg = argv[i];
    const bool more = i + 1 < argc;
    if (arg == "--most" && more)
      o.most = static_cast<uint32_t>(std::atof(argv[++i]));
    else if (arg == "--repeats" && more)
      o.repeats = std::atoi(argv[++i]);
    else if (arg == "--only" && more)
      o.only = argv[++i];
    else if (arg == "--alone")
      o.alone = true;
    else
      o.files.emplace_back(arg);
  }
  return o;
}

std::vector<NamedMesh> MeshesFor(const Options& o) {
  if (o.files.empty()) return StandardMeshes(o.most);
  std::vector<NamedMesh> meshes;
  for (const std::string& file : o.files) {
    meshes.push_back({file, {}});
    if (const tool::Status s = tool::read_mesh(file, meshes.back().mesh); !s) {
      std::fprintf(stderr, "%s\n", s.message.c_str());
      std::exit(2);
    }
  }
  return meshes;
}

// Whether all agree.
bool Compare(const NamedMesh& named, const Options& o) {
  const Mesh& mesh = named.mesh;
  const double per_triangle = 1e9 / TriangleCount(mesh);
  const size_t count = o.alone ? 1 : std::size(detectors);
  // The first run of a turn is slow, on memory that is new.
  const int turns = count > 1 && o.repeats >= 4 ? 2 : 1;
  std::vector<Measured> best(count);
  bool equal = true;
  for (int turn = 0; turn < turns; ++turn)
    for (size_t i = 0; i < count; ++i) {
      Measured now = detectors[i].run(mesh, (o.repeats + turns - 1) / turns);
      if (turn > 0) now.seconds = std::min(now.seconds, best[i].seconds);
      best[i] = std::move(now);
      equal = equal && best[i].pairs == best[0].pairs;
    }
  std::printf("%-20s %9u %8zu", named.name.c_str(), TriangleCount(mesh), best[0].pairs.size());
  double fastest = 1e30;
  for (size_t i = 0; i < count; ++i) {
    std::printf(" %8.1f", best[i].seconds * per_triangle);
    if (i > 0) fastest = std::min(fastest, best[i].seconds);
  }
  if (count > 1) std::printf(" %7.1f  %s", fastest / best[0].seconds, equal ? "equal" : "DIFFERENT");
  std::printf("\n");
  std::fflush(stdout);
  return equal;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = Read(argc, argv);
  std::printf("%-20s %9s %8s", "mesh", "triangles", "pairs");
  for (const Detector& detector : detectors)
    if (!options.alone || detector.run == DetectOurs) std::printf(" %8s", detector.name);
  std::printf("%s\n", options.alone || std::size(detectors) == 1 ? "" : "   ratio  pairs");
  bool equal = true;
  for (const NamedMesh& named : MeshesFor(options))
    if (named.name.find(options.only) != std::string::npos) equal = Compare(named, options) && equal;
  return equal ? 0 : 1;
}
