// step_bench: what a step costs, and what one topological event adds to it.
//
//   step_bench [--most VERTICES] [--repeats N] [--alone merge|event|few] [--beyond EDGES]
//
// Merging: two spheres move into each other, a quarter of an edge each per step, from before their first contact until
// they overlap by eight edges; each vertex goes with the sphere that it is nearer to. Nanoseconds per vertex and step.
// Event: a thin spherical shell that is pierced in one place, by .6 edges and by .1, or as far as is given. Only a patch
// of vertices moves. What the event costs is the time of that step less that of a step in which the same patch moves the
// other way and meets nothing: of the first of several runs from the same snapshot, and of the least. Then all events in
// a row, with a step between them that meets nothing, each with what those before it have left to do; mean times of both
// kinds of steps, as a whole. Few: a sphere of which a round patch moves up and down by a hundredth of an edge; time of a
// step.
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <string_view>

#include "arena.h"
#include "points.h"
#include "sphere.h"

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

// Processor time: the machine may be busy with other things.
double Now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

[[noreturn]] void Fail(const char* what, const tpa_issue& issue) {
  char text[256];
  tpa_issue_text(&issue, text, sizeof text);
  std::fprintf(stderr, "step_bench: %s: %s\n", what, text);
  std::exit(2);
}

void Check(tpa_status status, const char* what, const tpa_issue& issue) {
  if (status != TPA_OK) Fail(what, issue);
}

// A sphere that make_sphere() cuts into n parts has 4 n^2 + 2 vertices.
int PartsFor(uint32_t vertices) { return static_cast<int>(std::lround(std::sqrt(vertices / 4.0))); }

double MeanEdge(const Mesh& m) {
  double sum = 0;
  for (size_t h = 0; h < m.triangles.size(); ++h) {
    const size_t next = h % 3 == 2 ? h - 2 : h + 1;
    const double *a = &m.positions[3 * size_t{m.triangles[h]}], *b = &m.positions[3 * size_t{m.triangles[next]}];
    sum += tool::length({b[0] - a[0], b[1] - a[1], b[2] - a[2]});
  }
  return sum / static_cast<double>(m.triangles.size());
}

void Append(Mesh& m, const Mesh& other, bool inward) {
  const uint32_t base = VertexCount(m);
  m.positions.insert(m.positions.end(), other.positions.begin(), other.positions.end());
  for (size_t t = 0; t < other.triangles.size(); t += 3)
    for (size_t i = 0; i < 3; ++i) m.triangles.push_back(base + other.triangles[t + (inward ? 2 - i : i)]);
}

tpa_mesh_view ViewOf(const tpa_context* context) {
  tpa_mesh_view view{};
  view.struct_size = sizeof view;
  tpa_view(context, &view);
  return view;
}

// ---------------------------------------------------------------- merging spheres

// Nanoseconds per vertex and step; of steps that meet nothing, of those that meet something, of remeshing.
struct MergeCost {
  double quiet = 0, busy = 0, remesh = 0;
  uint32_t quiet_steps = 0, busy_steps = 0, remeshes = 0, events = 0, vertices = 0;
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
    if (!remeshing) continue;
    const double before = Now();
    Check(tpa_remesh(arena.context, &options, nullptr, nullptr, &issue), "tpa_remesh", issue);
    cost.remesh += 1e9 * (Now() - before) / n;
    ++cost.remeshes;
  }
  cost.quiet /= std::max(1u, cost.quiet_steps);
  cost.busy /= std::max(1u, cost.busy_steps);
  cost.remesh /= std::max(1u, cost.remeshes);
  cost.vertices = ViewOf(arena.context).vertex_count;
  return cost;
}

void MergeTable(const Options& o) {
  std::printf("merging spheres, ns per vertex and step\n%9s %8s %8s %8s %8s %9s %8s\n", "vertices", "remesh?", "quiet",
              "busy", "remesh", "all", "groups");
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
      std::printf("%9u %8s %8.0f %8.0f %8.0f %9.0f %8u\n", vertices, remeshing ? "yes" : "no", best.quiet, best.busy,
                  best.remesh, all, best.events);
      std::fflush(stdout);
    }
  }
}

// ---------------------------------------------------------------- one event

constexpr double thickness = 2, patch = 4;  // in edges

struct Shell {
  Mesh mesh;
  double edge = 0;
  double bump = 0;  // how far it is pushed, in edges
};

Shell MakeShell(uint32_t vertices, double beyond) {
  const int parts = PartsFor(vertices / 2);
  Shell s;
  s.bump = thickness + beyond;
  s.mesh = tool::make_sphere({0, 0, 0}, 1, parts);
  s.edge = MeanEdge(s.mesh);
  Append(s.mesh, tool::make_sphere({0, 0, 0}, 1 - thickness * s.edge, parts), true);
  return s;
}

// The patch of the inner sphere round a direction and where it goes: out through the outer sphere, or in.
struct Move {
  std::vector<uint32_t> vertices;
  std::vector<double> targets;
};

Move MoveOf(const tpa_mesh_view& view, const Shell& shell, const Point& direction, bool outwards) {
  Move m;
  const double edge = shell.edge;
  const Point top = (1 - thickness * edge) * direction;
  for (uint32_t v = 0; v < view.vertex_count; ++v) {
    const Point p{view.positions[3 * size_t{v}], view.positions[3 * size_t{v} + 1], view.positions[3 * size_t{v} + 2]};
    const double far = tool::length(p - top) / (patch * edge);
    if (far >= 1 || tool::length(p) > 1 - 0.75 * thickness * edge) continue;
    const double way = (outwards ? 1 : -1) * shell.bump * edge * (1 - far * far);
    const Point to = p + way * direction;
    m.vertices.push_back(v);
    m.targets.insert(m.targets.end(), to.begin(), to.end());
  }
  return m;
}

// In seconds.
double StepTime(tpa_context* context, const Move& m, tpa_report& report) {
  tpa_issue issue{};
  tpa_move_input move{};
  move.struct_size = sizeof move;
  move.count = static_cast<uint32_t>(m.vertices.size());
  move.position_type = TPA_FLOAT64;
  move.positions = m.targets.data();
  move.vertices = m.vertices.data();
  report.struct_size = sizeof report;
  Check(tpa_move(context, &move, &issue), "tpa_move", issue);
  const double start = Now();
  Check(tpa_step(context, nullptr, &report, &issue), "tpa_step", issue);
  return Now() - start;
}

// The first and the least of several runs from the snapshot. A processor that has run a step a few times knows its
// branches by heart.
struct RunTimes {
  double first, least;
};
RunTimes TimesOf(const Arena& arena, const std::vector<char>& snapshot, const Move& m, int repeats,
                 tpa_report& report) {
  RunTimes t{0, 1e30};
  for (int i = 0; i < repeats; ++i) {
    std::memcpy(arena.block.get(), snapshot.data(), snapshot.size());
    const double taken = StepTime(arena.context, m, report);
    if (i == 0) t.first = taken;
    t.least = std::min(t.least, taken);
  }
  return t;
}

// Mean times of steps one after another, those that meet something and those that do not, in turns; in microseconds.
struct RowTimes {
  double events = 0, between = 0;
};
RowTimes TimesInARow(const Arena& arena, const std::vector<char>& snapshot, const Shell& shell, int events) {
  std::memcpy(arena.block.get(), snapshot.data(), snapshot.size());
  tool::Dice dice(1);
  RowTimes sum;
  uint32_t met = 0, quiet = 0;
  for (int i = 0; i < 2 * events; ++i) {
    tpa_report report{};
    const bool outwards = i % 2 == 0;
    const Move m = MoveOf(ViewOf(arena.context), shell, dice.direction(), outwards);
    const double taken = 1e6 * StepTime(arena.context, m, report);
    // Where another event has been a patch may have little left, or meet something on its way in.
    if (outwards != (report.contacts > 0)) continue;
    (outwards ? sum.events : sum.between) += taken;
    ++(outwards ? met : quiet);
  }
  return {sum.events / std::max(1u, met), sum.between / std::max(1u, quiet)};
}

void EventRow(uint32_t vertices, int events, int repeats, double beyond) {
  const Shell shell = MakeShell(vertices, beyond);
  tpa_config config = ConfigFor(shell.mesh);
  config.max_vertices += 4096;
  tpa_arena_size size{};
  const Arena arena(config);
  tpa_issue issue = arena.issue;
  if (arena.context == nullptr) Fail("tpa_init", issue);
  Check(tpa_arena_query(&config, &size, &issue), "tpa_arena_query", issue);
  const tpa_mesh_input input = InputOf(shell.mesh);
  Check(tpa_load(arena.context, &input, &issue), "tpa_load", issue);
  // In the middle of a run a context knows what the steps before have told it; here a vertex moved in one, by a hair.
  double still[3] = {shell.mesh.positions[0], shell.mesh.positions[1], shell.mesh.positions[2] * (1 - 1e-9)};
  tpa_move_input hair{};
  hair.struct_size = sizeof hair;
  hair.count = 1;
  hair.position_type = TPA_FLOAT64;
  hair.positions = still;
  Check(tpa_move(arena.context, &hair, &issue), "tpa_move", issue);
  Check(tpa_step(arena.context, nullptr, nullptr, &issue), "tpa_step", issue);
  const char* const bytes = static_cast<const char*>(arena.block.get());
  const std::vector<char> snapshot(bytes, bytes + size.bytes);
  tool::Dice dice(1);
  std::vector<double> quiets, firsts, leasts;
  uint32_t pierced = 0;
  for (int i = 0; i < events; ++i) {
    const Point direction = dice.direction();
    tpa_report report{};
    std::memcpy(arena.block.get(), snapshot.data(), snapshot.size());
    const tpa_mesh_view view = ViewOf(arena.context);
    const Move in = MoveOf(view, shell, direction, false), out = MoveOf(view, shell, direction, true);
    const RunTimes quiet = TimesOf(arena, snapshot, in, repeats, report);
    const RunTimes busy = TimesOf(arena, snapshot, out, repeats, report);
    pierced += report.handles[0];
    quiets.push_back(1e6 * quiet.least);
    firsts.push_back(1e6 * (busy.first - quiet.first));
    leasts.push_back(1e6 * (busy.least - quiet.least));
  }
  const auto quantile = [](std::vector<double>& x, double q) {
    std::sort(x.begin(), x.end());
    return x[std::min(x.size() - 1, static_cast<size_t>(q * static_cast<double>(x.size())))];
  };
  const RowTimes row = TimesInARow(arena, snapshot, shell, 200);
  std::printf("%9u %7d %8u %10.0f %10.0f %10.0f %10.0f %10.0f %10.0f %10.0f\n", VertexCount(shell.mesh), events,
              pierced, quantile(quiets, 0.5), quantile(firsts, 0.5), quantile(firsts, 0.99), quantile(leasts, 0.5),
              quantile(leasts, 0.99), row.events, row.between);
  std::fflush(stdout);
}

void EventTable(const Options& o, double beyond) {
  std::printf("one event, %.1f edges beyond the other side, microseconds\n", beyond);
  std::printf("%9s %7s %8s %10s %10s %10s %10s %10s %10s %10s\n", "vertices", "events", "handles", "quiet step",
              "first", "99 %", "least", "99 %", "in a row", "between");
  struct Row {
    uint32_t vertices;
    int events;
  };
  for (const Row& row : {Row{2500, 200}, Row{10000, 200}, Row{40000, 100}, Row{160000, 50}, Row{640000, 20}})
    if (row.vertices >= o.least && row.vertices <= o.most) EventRow(row.vertices, row.events, o.repeats, beyond);
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
    for (const double beyond : o.beyond) EventTable(o, beyond);
  if (o.alone.empty() || o.alone == "few") FewTable(o);
}
