// SPDX-License-Identifier: MIT
// step_bench: what a step costs, and what one topological event adds to it.
//
//   step_bench [--least VERTICES] [--most VERTICES] [--repeats N] [--remeshing no|yes]
//              [--alone merge|event|few] [--beyond EDGES]
//
// Merging: two spheres move into each other, and all vertices with them. Nanoseconds per vertex and step
// (merge_table.cpp).
// Event: a thin spherical shell that is pierced in one place, by .6 edges and by .1, or as far as is given. Only a
// patch of vertices moves; microseconds beyond a step that meets nothing (event_table.cpp). Few: a sphere of which a
// round patch moves up and down by a hundredth of an edge; time of a step.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string_view>

#include "event_table.h"
#include "merge_table.h"
#include "stepping.h"
#include "tool/scenes/sphere.h"

namespace {

using namespace bench;

struct Options {
  uint32_t least = 0, most = 700000;  // vertices
  int repeats = 3;
  std::string_view alone, remeshing;
  std::vector<double> beyond{.6, .1};  // by how much a shell is pierced, in edges
};

// ---------------------------------------------------------------- few that move

// That share of the vertices, those that lie farthest in one direction.
std::vector<uint32_t> Topmost(const Mesh& mesh, double share) {
  const auto height = [&](uint32_t v) {
    const double* p = &mesh.positions[3 * size_t{v}];
    return 3 * p[0] + 4 * p[1] + 5 * p[2];
  };
  std::vector<uint32_t> vertices(VertexCount(mesh));
  std::iota(vertices.begin(), vertices.end(), 0u);
  std::stable_sort(vertices.begin(), vertices.end(), [&](uint32_t a, uint32_t b) { return height(a) > height(b); });
  vertices.resize(static_cast<size_t>(share * VertexCount(mesh) + 0.5));
  std::sort(vertices.begin(), vertices.end());
  return vertices;
}

// The least time of a step, in microseconds, of which the first two are left out.
double FewTime(tpa_context* context, const Mesh& mesh, double edge, double share, int repeats) {
  Move moves[2];
  moves[0].vertices = moves[1].vertices = Topmost(mesh, share);
  for (const uint32_t v : moves[0].vertices)
    for (int up = 0; up < 2; ++up)
      for (uint32_t k = 0; k < 3; ++k)
        moves[up].targets.push_back((1 + 0.01 * up * edge) * mesh.positions[3 * size_t{v} + k]);
  double best = 1e30;
  for (int i = 0; i < 2 * repeats + 2; ++i) {
    tpa_report report{};
    const double taken = StepTime(context, moves[i % 2], report);
    if (i >= 2) best = std::min(best, taken);
  }
  return 1e6 * best;
}

void FewTable(const Options& o) {
  constexpr double shares[] = {0, 0.0001, 0.001, 0.01, 1};
  std::printf("few that move, microseconds\n%9s %10s %10s %10s %10s %10s\n", "vertices", "none", ".01 %", ".1 %", "1 %",
              "all");
  for (uint32_t vertices : {10000u, 40000u, 160000u, 640000u}) {
    if (vertices < o.least || vertices > o.most) continue;
    const Mesh mesh = tool::make_sphere({0, 0, 0}, 1, PartsFor(vertices));
    const Arena arena(ConfigFor(mesh));
    tpa_issue issue = arena.issue;
    if (arena.context == nullptr) Fail("tpa_init", issue);
    const tpa_mesh_input input = InputOf(mesh);
    Check(tpa_load(arena.context, &input, &issue), "tpa_load", issue);
    std::printf("%9u", VertexCount(mesh));
    for (double share : shares) std::printf(" %10.1f", FewTime(arena.context, mesh, MeanEdge(mesh), share, o.repeats));
    std::printf("\n");
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; i += 2) {
    const std::string_view arg = argv[i];
    if (arg == "--least" && i + 1 < argc) {
      o.least = static_cast<uint32_t>(std::atof(argv[i + 1]));
    } else if (arg == "--remeshing" && i + 1 < argc) {
      o.remeshing = argv[i + 1];
    } else if (arg == "--most" && i + 1 < argc) {
      o.most = static_cast<uint32_t>(std::atof(argv[i + 1]));
    } else if (arg == "--repeats" && i + 1 < argc) {
      o.repeats = std::max(1, std::atoi(argv[i + 1]));
    } else if (arg == "--beyond" && i + 1 < argc) {
      o.beyond = {std::atof(argv[i + 1])};
    } else if (arg == "--alone" && i + 1 < argc) {
      o.alone = argv[i + 1];
    } else {
      std::fprintf(stderr,
                   "usage: step_bench [--least VERTICES] [--most VERTICES] [--repeats N] [--remeshing no|yes]\n"
                   "                  [--alone merge|event|few] [--beyond EDGES]\n");
      return 2;
    }
  }
  if (o.alone.empty() || o.alone == "merge") MergeTable(o.least, o.most, o.remeshing, o.repeats);
  if (o.alone.empty() || o.alone == "event")
    for (const double beyond : o.beyond) EventTable(o.least, o.most, o.repeats, beyond);
  if (o.alone.empty() || o.alone == "few") FewTable(o);
}
