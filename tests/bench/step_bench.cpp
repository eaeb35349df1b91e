// step_bench: what a step costs, and what one topological event adds to it.
//
//   step_bench [--least VERTICES] [--most VERTICES] [--repeats N] [--remeshing no|yes]
//              [--alone merge|event|few] [--beyond EDGES]
//
// Merging: two spheres move into each other, a quarter of an edge each per step, from before their first contact until
// they overlap by eight edges; each vertex goes with the sphere that it is nearer to. Nanoseconds per vertex and step,
// and how many contacts a group has, in the mean.
// Event: a thin spherical shell that is pierced in one place, by .6 edges and by .1, or as far as is given. Only a patch
// of vertices moves; microseconds beyond a step that meets nothing (event_table.cpp).
// Few: a sphere of which a round patch moves up and down by a hundredth of an edge; time of a step.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <numeric>
#include <string_view>

#include "event_table.h"
#include "sphere.h"
#include "stepping.h"

namespace {

using namespace bench;
using tool::Point;
using tool::operator+, tool::operator-, tool::operator*;

struct Options {
  uint32_t least = 0, most = 700000;  // vertices
  int repeats = 3;
  std::string_view alone, remeshing;
  std::vector<double> beyond{.6, .1};  // by how much a shell is pierced, in edges
};

// ---------------------------------------------------------------- merging spheres

// Nanoseconds per vertex and step; of steps that meet nothing, of those that meet something, of remeshing.
struct MergeCost {
  double quiet = 0, busy = 0, remesh = 0;
  uint32_t quiet_steps = 0, busy_steps = 0, remeshes = 0, events = 0, contacts = 0;
};

constexpr int quiet_edges = 2, overlap_edges = 8;
constexpr double stride = 0.25;

// On the unit sphere about (x, 0, 0).
Point OnSphere(const double* p, double x) {
  const Point d{p[0] - x, p[1], p[2]};
  return Point{x, 0, 0} + 1 / tool::length(d) * d;
}

MergeCost Merge(uint32_t vertices, bool remeshing) {
  const int parts = PartsFor(vertices / 2);
  Mesh mesh;
  const Mesh one = tool::make_sphere({0, 0, 0}, 1, parts);
  const double edge = MeanEdge(one);
  double x = 1 + 0.5 * quiet_edges * edge;
  Append(mesh, tool::make_sphere({-x, 0, 0}, 1, parts), false);
  Append(mesh, tool::make_sphere({x, 0, 0}, 1, parts), false);
  tpa_config config = ConfigFor(mesh);
  config.max_vertices += config.max_vertices / 2;
  const Arena arena(config);
  tpa_issue issue = arena.issue;
  if (arena.context == nullptr) Fail("tpa_init", issue);
  const tpa_mesh_input input = InputOf(mesh);
  Check(tpa_load(arena.context, &input, &issue), "tpa_load", issue);
  tpa_remesh_options options{};
  options.struct_size = sizeof options;
  options.iterations = 1;
  options.target_length = edge;
  options.relaxation = 0.5;

  MergeCost cost;
  std::vector<double> targets;
  const int steps = static_cast<int>((quiet_edges + overlap_edges) / (2 * stride));
  for (int step = 0; step < steps; ++step) {
    const tpa_mesh_view view = ViewOf(arena.context);
    const uint32_t n = view.vertex_count;
    targets.resize(3 * size_t{n});
    for (size_t v = 0; v < n; ++v) {
      const double* p = view.positions + 3 * v;
      const double left = tool::length({p[0] + x, p[1], p[2]}) - 1, right = tool::length({p[0] - x, p[1], p[2]}) - 1;
      const double side = std::fabs(left) <= std::fabs(right) ? -1 : 1;
      const Point to = OnSphere(p, side * x) - Point{side * stride * edge, 0, 0};
      // The library takes no coordinates smaller than that but zero.
      for (size_t i = 0; i < 3; ++i) targets[3 * v + i] = std::fabs(to[i]) < 0x1p-100 ? 0 : to[i];
    }
    x -= stride * edge;
    tpa_move_input move{};
    move.struct_size = sizeof move;
    move.count = n;
    move.position_type = TPA_FLOAT64;
    move.positions = targets.data();
    tpa_report report{};
    report.struct_size = sizeof report;
    const double start = Now();
    Check(tpa_move(arena.context, &move, &issue), "tpa_move", issue);
    Check(tpa_step(arena.context, nullptr, &report, &issue), "tpa_step", issue);
    const double taken = 1e9 * (Now() - start) / n;
    // The first step after tpa_load looks at the whole mesh once more.
    if (step == 0) continue;
    (report.contacts == 0 ? cost.quiet : cost.busy) += taken;
    ++(report.contacts == 0 ? cost.quiet_steps : cost.busy_steps);
    cost.events += report.groups;
    cost.contacts += report.contacts;
    if (!remeshing) continue;
    const double before = Now();
    Check(tpa_remesh(arena.context, &options, nullptr, nullptr, &issue), "tpa_remesh", issue);
    cost.remesh += 1e9 * (Now() - before) / n;
    ++cost.remeshes;
  }
  cost.quiet /= std::max(1u, cost.quiet_steps);
  cost.busy /= std::max(1u, cost.busy_steps);
  cost.remesh /= std::max(1u, cost.remeshes);
  return cost;
}

void MergeTable(const Options& o) {
  std::printf("merging spheres, ns per vertex and step\n%9s %8s %8s %8s %8s %9s %8s %9s\n", "vertices", "remesh?", "quiet",
              "busy", "remesh", "all", "groups", "contacts");
  for (uint32_t vertices : {2400u, 10000u, 40000u}) {
    if (vertices < o.least || vertices > o.most) continue;
    for (bool remeshing : {false, true}) {
      if (!o.remeshing.empty() && o.remeshing != (remeshing ? "yes" : "no")) continue;
      MergeCost best = Merge(vertices, remeshing);
      for (int i = 1; i < o.repeats; ++i) {
        const MergeCost again = Merge(vertices, remeshing);
        best.quiet = std::min(best.quiet, again.quiet);
        best.busy = std::min(best.busy, again.busy);
        best.remesh = std::min(best.remesh, again.remesh);
      }
      const double all = (best.quiet * best.quiet_steps + best.busy * best.busy_steps) /
                             (best.quiet_steps + best.busy_steps) + best.remesh;
      std::printf("%9u %8s %8.0f %8.0f %8.0f %9.0f %8u %9.1f\n", vertices, remeshing ? "yes" : "no", best.quiet, best.busy,
                  best.remesh, all, best.events, static_cast<double>(best.contacts) / std::max(1u, best.events));
      std::fflush(stdout);
    }
  }
}

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
      std::fprintf(stderr, "usage: step_bench [--least VERTICES] [--most VERTICES] [--repeats N] [--remeshing no|yes]\n"
                   "                  [--alone merge|event|few] [--beyond EDGES]\n");
      return 2;
    }
  }
  if (o.alone.empty() || o.alone == "merge") MergeTable(o);
  if (o.alone.empty() || o.alone == "event")
    for (const double beyond : o.beyond) EventTable(o.least, o.most, o.repeats, beyond);
  if (o.alone.empty() || o.alone == "few") FewTable(o);
}
