// detect_bench: the library and its peers on the same meshes in the same run. Prints nanoseconds per triangle and how
// many times faster the library is than the fastest peer. Exit 1 where the pairs differ.
//
//   detect_bench [--most VERTICES] [--repeats N] [--only TEXT] [--alone] [MESH...]
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "detectors.h"

namespace {

using namespace bench;

constexpr Detector peers[] = {
#ifdef BENCH_CGAL
    {"CGAL", DetectWithCgal},
#endif
#ifdef BENCH_EMBREE
    {"Embree", DetectWithEmbree},
#endif
};

struct Options {
  uint32_t most = 400000;  // vertices of a mesh
  int repeats = 3;
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
  const Measured ours = DetectOurs(mesh, o.repeats);
  std::printf("%-20s %9u %8zu %8.1f", named.name.c_str(), TriangleCount(mesh), ours.pairs.size(),
              ours.seconds * per_triangle);
  std::fflush(stdout);
  double fastest = 1e30;
  bool equal = true;
  for (const Detector& peer : peers) {
    if (o.alone) break;
    const Measured theirs = peer.run(mesh, o.repeats);
    fastest = std::min(fastest, theirs.seconds);
    equal = equal && theirs.pairs == ours.pairs;
    std::printf(" %8.1f", theirs.seconds * per_triangle);
    std::fflush(stdout);
  }
  if (fastest < 1e30) std::printf(" %7.1f  %s", fastest / ours.seconds, equal ? "equal" : "DIFFERENT");
  std::printf("\n");
  return equal;
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = Read(argc, argv);
  std::printf("%-20s %9s %8s %8s", "mesh", "triangles", "pairs", "ours");
  if (!options.alone)
    for (const Detector& peer : peers) std::printf(" %8s", peer.name);
  std::printf("%s\n", options.alone ? "" : "   ratio  pairs");
  bool equal = true;
  for (const NamedMesh& named : MeshesFor(options))
    if (named.name.find(options.only) != std::string::npos) equal = Compare(named, options) && equal;
  return equal ? 0 : 1;
}
