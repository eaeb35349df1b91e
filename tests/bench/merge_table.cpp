// SPDX-License-Identifier: MIT
// Two spheres move into each other, a quarter of an edge each per step, from before their first contact until they
// overlap by eight edges; each vertex goes with the sphere that it is nearer to, so all of them move in each step.
// Nanoseconds per vertex and step; with how many contacts each of its contact groups has. What an event takes there
// cannot be told: what its step takes apart from it differs from step to step by as much (event_table.cpp tells).
#include "merge_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "quantile.h"
#include "stepping.h"
#include "tool/scenes/sphere.h"

namespace bench {
namespace {

using tool::Point;
using tool::operator+, tool::operator-, tool::operator*;

constexpr int quiet_edges = 2, overlap_edges = 8;
constexpr double stride = 0.25;

struct Spheres {
  Mesh mesh;
  double edge = 0;
  double x = 0;  // their centers are at x and -x
};

Spheres MakeSpheres(uint32_t vertices) {
  const int parts = PartsFor(vertices / 2);
  Spheres s;
  s.edge = MeanEdge(tool::make_sphere({0, 0, 0}, 1, parts));
  s.x = 1 + 0.5 * quiet_edges * s.edge;
  for (const double side : {-1., 1.}) Append(s.mesh, tool::make_sphere({side * s.x, 0, 0}, 1, parts), false);
  return s;
}

// On the unit sphere about (x, 0, 0).
Point OnSphere(const double* p, double x) {
  const Point d{p[0] - x, p[1], p[2]};
  return Point{x, 0, 0} + 1 / tool::length(d) * d;
}

// Where the vertices go, with the nearer sphere.
void Approach(const tpa_mesh_view& view, const Spheres& s, std::vector<double>& targets) {
  targets.resize(3 * size_t{view.vertex_count});
  for (size_t v = 0; v < view.vertex_count; ++v) {
    const double* p = view.positions + 3 * v;
    const double left = tool::length({p[0] + s.x, p[1], p[2]}) - 1, right = tool::length({p[0] - s.x, p[1], p[2]}) - 1;
    const double side = std::fabs(left) <= std::fabs(right) ? -1 : 1;
    const Point to = OnSphere(p, side * s.x) - Point{side * stride * s.edge, 0, 0};
    // The library takes no coordinates smaller than that but zero.
    for (size_t i = 0; i < 3; ++i) targets[3 * v + i] = std::fabs(to[i]) < 0x1p-100 ? 0 : to[i];
  }
}

// Of tpa_move and tpa_step, in microseconds.
double MoveAll(tpa_context* context, const std::vector<double>& targets, tpa_report& report) {
  tpa_issue issue{};
  tpa_move_input move{};
  move.struct_size = sizeof move;
  move.count = static_cast<uint32_t>(targets.size() / 3);
  move.position_type = TPA_FLOAT64;
  move.positions = targets.data();
  report.struct_size = sizeof report;
  const double start = Now();
  Check(tpa_move(context, &move, &issue), "tpa_move", issue);
  Check(tpa_step(context, nullptr, &report, &issue), "tpa_step", issue);
  return 1e6 * (Now() - start);
}

double Remesh(tpa_context* context, double edge) {
  tpa_remesh_options options{};
  options.struct_size = sizeof options;
  options.iterations = 1;
  options.target_length = edge;
  options.relaxation = 0.5;
  tpa_issue issue{};
  const double start = Now();
  Check(tpa_remesh(context, &options, nullptr, nullptr, &issue), "tpa_remesh", issue);
  return 1e6 * (Now() - start);
}

// In microseconds: a step, and the sweep of remeshing after it.
struct Step {
  double taken = 0, remesh = 0;
  uint32_t vertices = 0, groups = 0, contacts = 0;
};

struct Run {
  uint32_t vertices;
  bool remeshing, by_hash;
};

std::vector<Step> Merge(const Run& run) {
  Spheres s = MakeSpheres(run.vertices);
  tpa_config config = ConfigFor(s.mesh);
  config.detect_mode = run.by_hash ? TPA_DETECT_VERTEX_HASH : TPA_DETECT_COMPLETE;
  config.cell_size = s.edge;
  config.max_vertices += config.max_vertices / 2;
  const Arena arena(config);
  tpa_issue issue = arena.issue;
  if (arena.context == nullptr) Fail("tpa_init", issue);
  const tpa_mesh_input input = InputOf(s.mesh);
  Check(tpa_load(arena.context, &input, &issue), "tpa_load", issue);

  std::vector<Step> done;
  std::vector<double> targets;
  const int steps = static_cast<int>((quiet_edges + overlap_edges) / (2 * stride));
  for (int i = 0; i < steps; ++i) {
    Approach(ViewOf(arena.context), s, targets);
    s.x -= stride * s.edge;
    tpa_report report{};
    Step step;
    step.taken = MoveAll(arena.context, targets, report);
    step.vertices = static_cast<uint32_t>(targets.size() / 3);
    step.groups = report.groups;
    step.contacts = report.contacts;
    if (run.remeshing) step.remesh = Remesh(arena.context, s.edge);
    // The first step after tpa_load looks at the whole mesh once more.
    if (i > 0) done.push_back(step);
  }
  return done;
}

// Each step with what it took at least.
std::vector<Step> MergeOften(const Run& run, int repeats) {
  std::vector<Step> least = Merge(run);
  for (int i = 1; i < repeats; ++i) {
    const std::vector<Step> again = Merge(run);
    for (size_t k = 0; k < least.size(); ++k) {
      least[k].taken = std::min(least[k].taken, again[k].taken);
      least[k].remesh = std::min(least[k].remesh, again[k].remesh);
    }
  }
  return least;
}

// Nanoseconds per vertex: of steps that meet nothing, of those that meet something, of remeshing.
struct Cost {
  double quiet = 0, busy = 0, remesh = 0, all = 0;
};

Cost CostOf(const std::vector<Step>& steps) {
  Cost sum;
  double quiet_steps = 0, busy_steps = 0;
  for (const Step& s : steps) {
    (s.contacts == 0 ? sum.quiet : sum.busy) += 1e3 * s.taken / s.vertices;
    (s.contacts == 0 ? quiet_steps : busy_steps) += 1;
    sum.remesh += 1e3 * s.remesh / s.vertices;
  }
  const double all = quiet_steps + busy_steps;
  return {sum.quiet / std::max(1., quiet_steps), sum.busy / std::max(1., busy_steps), sum.remesh / all,
          (sum.quiet + sum.busy + sum.remesh) / all};
}

void MergeRow(const Run& run, int repeats) {
  const std::vector<Step> steps = MergeOften(run, repeats);
  const Cost cost = CostOf(steps);
  std::vector<double> contacts;  // of each contact group, its share of its step
  for (const Step& s : steps) {
    const double groups = std::max(1u, s.groups);
    contacts.insert(contacts.end(), s.groups, s.contacts / groups);
  }
  std::printf("%9u %8s %8s %8.0f %8.0f %8.0f %8.0f %8zu %9.1f %6.1f\n", run.vertices, run.by_hash ? "hash" : "complete",
              run.remeshing ? "yes" : "no", cost.quiet, cost.busy, cost.remesh, cost.all, contacts.size(),
              Quantile(contacts, 0.5), Quantile(contacts, 0.9));
  std::fflush(stdout);
}

}  // namespace

void MergeTable(uint32_t least, uint32_t most, std::string_view remeshing, int repeats) {
  std::printf("merging spheres, ns per vertex and step; contacts of a group\n");
  std::printf("%9s %8s %8s %8s %8s %8s %8s %8s %9s %6s\n", "vertices", "detect", "remesh?", "quiet", "busy", "remesh",
              "all", "groups", "contacts", "90 %");
  for (const uint32_t vertices : {2400u, 10000u, 40000u}) {
    if (vertices < least || vertices > most) continue;
    for (const bool by_hash : {false, true})
      for (const bool with : {false, true})
        if (remeshing.empty() || with == (remeshing == "yes")) MergeRow({vertices, with, by_hash}, repeats);
  }
}

}  // namespace bench
