// SPDX-License-Identifier: MIT
// detect_bench: the library and its peers on the same meshes in the same run. Prints nanoseconds per triangle and how
// many times faster the library is than the fastest peer. Exit 1 where the pairs differ.
//
//   detect_bench [--shared FOLDER] [--most VERTICES] [--repeats N] [--only TEXT] [--alone] [MESH...]
//
// Real meshes come first, those in the shared folder and generated ones like them, then the even ones.
// The least time of all runs counts. Detectors take turns, half of their runs each where these are four or more, so
// that none has the better hour of a machine that others use as well.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string_view>

#include "detectors.h"
#include "real_meshes.h"

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
  std::string shared = "../shared";
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
    else if (arg == "--shared" && more)
      o.shared = argv[++i];
    else if (arg == "--alone")
      o.alone = true;
    else
      o.files.emplace_back(arg);
  }
  return o;
}

std::vector<NamedMesh> Read(const std::vector<std::string>& files) {
  std::vector<NamedMesh> meshes;
  for (const std::string& file : files) {
    meshes.push_back({file, {}});
    if (const tool::Status s = tool::read_mesh(file, meshes.back().mesh); !s) {
      std::fprintf(stderr, "%s\n", s.message.c_str());
      std::exit(2);
    }
  }
  return meshes;
}

// The ratios of a table.
struct Ratios {
  double logarithms = 0, least = 1e30;
  int count = 0;
  void Add(double ratio) {
    logarithms += std::log(ratio);
    least = std::min(least, ratio);
    ++count;
  }
};

// Whether all agree.
bool Compare(const NamedMesh& named, const Options& o, Ratios& ratios) {
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
  if (count > 1) {
    ratios.Add(fastest / best[0].seconds);
    std::printf(" %7.1f  %s", fastest / best[0].seconds, equal ? "equal" : "DIFFERENT");
  }
  std::printf("\n");
  std::fflush(stdout);
  return equal;
}

// Whether all agree on all meshes.
bool Table(const char* name, const std::vector<NamedMesh>& meshes, const Options& o) {
  std::printf("%-20s %9s %8s", name, "triangles", "pairs");
  for (const Detector& detector : detectors)
    if (!o.alone || detector.run == DetectOurs) std::printf(" %8s", detector.name);
  std::printf("%s\n", o.alone || std::size(detectors) == 1 ? "" : "   ratio  pairs");
  bool equal = true;
  Ratios ratios;
  for (const NamedMesh& named : meshes)
    if (named.name.find(o.only) != std::string::npos && IsLoaded(named.mesh, named.name))
      equal = Compare(named, o, ratios) && equal;
  if (ratios.count > 1)
    std::printf("geometric mean %.1f, least %.1f\n", std::exp(ratios.logarithms / ratios.count), ratios.least);
  return equal;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = Read(argc, argv);
  if (!options.files.empty()) return Table("files", Read(options.files), options) ? 0 : 1;
  bool equal = Table("real", FilesIn(options.shared), options);
  equal = Table("like real ones", RealMeshes(options.only), options) && equal;
  equal = Table("even", StandardMeshes(options.most), options) && equal;
  return equal ? 0 : 1;
}
