// SPDX-License-Identifier: MIT
// remesh_bench: tpa_remesh beside CGAL's isotropic_remeshing, in one run: seconds of processor time, and the triangles
// by their angles, lengths of edges and distances to the surface, with the pairs that meet. Then what a sweep costs on
// a mesh at rest, for a vertex and operation tried, and for an operation done.
//
//   remesh_bench [--repeats N] [--sweeps N] [MESH...]
#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "arena.h"
#include "quantile.h"
#include "remeshers.h"

namespace {

using bench::Mesh;

double Now() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

struct Vector {
  double x, y, z;
};
Vector Between(const Mesh& m, uint32_t a, uint32_t b) {
  const double *p = &m.positions[3 * size_t{a}], *q = &m.positions[3 * size_t{b}];
  return {q[0] - p[0], q[1] - p[1], q[2] - p[2]};
}
double Dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double Length(const Vector& a) { return std::sqrt(Dot(a, a)); }

double MeanEdge(const Mesh& m) {
  double sum = 0;
  for (size_t h = 0; h < m.triangles.size(); ++h)
    sum += Length(Between(m, m.triangles[h], m.triangles[h % 3 == 2 ? h - 2 : h + 1]));
  return sum / static_cast<double>(m.triangles.size());
}

struct Quality {
  double least_angle = 180, below_30 = 0, mean_least = 0;  // degrees; share of triangles with a lesser angle
  double in_band = 0, spread = 0;                          // edges from 4/5 to 4/3 of the length; deviation in lengths
};

Quality QualityOf(const Mesh& m, double length) {
  Quality q;
  const double triangles = static_cast<double>(m.triangles.size()) / 3;
  double sum = 0, squares = 0;
  for (size_t t = 0; t < m.triangles.size(); t += 3) {
    double least = 180;
    for (size_t i = 0; i < 3; ++i) {
      const uint32_t a = m.triangles[t + i], b = m.triangles[t + (i + 1) % 3], c = m.triangles[t + (i + 2) % 3];
      const Vector u = Between(m, a, b), v = Between(m, a, c);
      const double cosine = Dot(u, v) / (Length(u) * Length(v)), edge = Length(u) / length;
      least = std::min(least, std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / 3.141592653589793);
      q.in_band += edge >= 0.8 && edge <= 4.0 / 3 ? 1 / (3 * triangles) : 0;
      sum += edge;
      squares += edge * edge;
    }
    q.least_angle = std::min(q.least_angle, least);
    q.below_30 += least < 30 ? 1 / triangles : 0;
    q.mean_least += least / triangles;
  }
  const double mean = sum / (3 * triangles);
  q.spread = std::sqrt(std::max(0.0, squares / (3 * triangles) - mean * mean)) / mean;
  return q;
}

[[noreturn]] void Fail(const char* what, const tpa_issue& issue) {
  char text[256];
  tpa_issue_text(&issue, text, sizeof text);
  std::fprintf(stderr, "remesh_bench: %s: %s\n", what, text);
  std::exit(2);
}

Mesh MeshOf(const tpa_context* context) {
  tpa_mesh_view view{};
  view.struct_size = sizeof view;
  tpa_view(context, &view);
  return {{view.positions, view.positions + 3 * size_t{view.vertex_count}},
          {view.triangles, view.triangles + 3 * size_t{view.triangle_count}}};
}

tpa_remesh_options OptionsFor(double length, uint32_t sweeps) {
  tpa_remesh_options options{};
  options.struct_size = sizeof options;
  options.iterations = sweeps;
  options.target_length = length;
  options.relaxation = 0.5;
  return options;
}

bench::Arena Loaded(const Mesh& mesh, uint32_t vertices) {
  tpa_config config = bench::ConfigFor(mesh);
  config.max_vertices = vertices;
  bench::Arena arena(config);
  const tpa_mesh_input input = bench::InputOf(mesh);
  tpa_issue issue = arena.issue;
  if (arena.context == nullptr || tpa_load(arena.context, &input, &issue) != TPA_OK) Fail("load", issue);
  // A step knows that the mesh is free of contacts; so does CGAL's remeshing, which never asks.
  tpa_contacts contacts{};
  contacts.struct_size = sizeof contacts;
  if (tpa_detect(arena.context, nullptr, &contacts, &issue) != TPA_OK) Fail("detect", issue);
  return arena;
}

bench::Remeshed RemeshWithUs(const Mesh& mesh, double length, uint32_t sweeps, uint32_t vertices) {
  bench::Arena arena = Loaded(mesh, vertices);
  const tpa_remesh_options options = OptionsFor(length, sweeps);
  tpa_issue issue;
  const double start = Now();
  if (tpa_remesh(arena.context, &options, nullptr, nullptr, &issue) != TPA_OK) Fail("remesh", issue);
  bench::Remeshed done;
  done.seconds = Now() - start;
  done.mesh = MeshOf(arena.context);
  return done;
}

// Real meshes may cross themselves: the library resolves them first, for both.
Mesh Resolved(const Mesh& mesh) {
  tpa_config config = bench::ConfigFor(mesh);
  config.max_vertices = 2 * bench::VertexCount(mesh) + 10000;
  bench::Arena arena(config);
  const tpa_mesh_input input = bench::InputOf(mesh);
  tpa_issue issue = arena.issue;
  if (arena.context == nullptr || tpa_load(arena.context, &input, &issue) != TPA_OK) Fail("load", issue);
  if (tpa_adapt(arena.context, nullptr, nullptr, &issue) != TPA_OK) Fail("adapt", issue);
  return MeshOf(arena.context);
}

void Print(const char* mesh, double part, const char* who, const bench::Remeshed& done, double length,
           [[maybe_unused]] const Mesh& before) {
  const Quality q = QualityOf(done.mesh, length);
  std::printf("%-16s %4.1f %-5s %8.3f %8u  %5.1f %5.2f %5.1f  %5.1f %5.3f", mesh, part, who, done.seconds,
              bench::VertexCount(done.mesh), q.least_angle, 100 * q.below_30, q.mean_least, 100 * q.in_band, q.spread);
#ifdef BENCH_CGAL_REMESH
  const bench::Distances there = bench::DistancesTo(done.mesh, before), back = bench::DistancesTo(before, done.mesh);
  std::printf("  %6.4f %6.3f  %5zu", std::max(there.mean, back.mean) / length, std::max(there.most, back.most) / length,
              bench::MeetingPairs(done.mesh));
#endif
  std::printf("\n");
  std::fflush(stdout);
}

template <class Run>
bench::Remeshed Median(int repeats, Run run) {
  std::vector<double> seconds;
  bench::Remeshed done;
  for (int i = 0; i < repeats; ++i) {
    done = run();
    seconds.push_back(done.seconds);
  }
  done.seconds = bench::Quantile(seconds, 0.5);
  return done;
}

void Compare(const bench::NamedMesh& named, int repeats, uint32_t sweeps) {
  const Mesh& mesh = named.mesh;
  for (const double part : {0.5, 1.0, 2.0}) {
    const double length = part * MeanEdge(mesh);
    const auto room = static_cast<uint32_t>(bench::VertexCount(mesh) * std::max(2.0, 4 / (part * part)) + 10000);
    Print(named.name.c_str(), part, "ours", Median(repeats, [&] { return RemeshWithUs(mesh, length, sweeps, room); }),
          length, mesh);
#ifdef BENCH_CGAL_REMESH
    Print(named.name.c_str(), part, "CGAL",
          Median(repeats, [&] { return bench::RemeshWithCgal(mesh, length, sweeps); }), length, mesh);
#endif
  }
}

// Three operations are tried for each vertex in a full sweep.
void PrintCosts(int levels) {
  const Mesh mesh = bench::Noisy(bench::Icosphere(levels, 1, 0), 0.2, 1);
  const tpa_remesh_options options = OptionsFor(MeanEdge(mesh), 1);
  bench::Arena arena = Loaded(mesh, 2 * bench::VertexCount(mesh));
  tpa_report report{};
  report.struct_size = sizeof report;
  const auto sweep = [&](tpa_context* context) {
    const double start = Now();
    tpa_issue issue;
    if (tpa_remesh(context, &options, nullptr, &report, &issue) != TPA_OK) Fail("remesh", issue);
    return Now() - start;
  };
  const double first = sweep(arena.context);
  const uint32_t done = report.splits + report.collapses + report.flips;
  for (int i = 0; i < 50 && report.splits + report.collapses + report.flips > 0; ++i) sweep(arena.context);
  const double rest = sweep(arena.context);
  const Mesh still = MeshOf(arena.context);
  bench::Arena anew = Loaded(still, 2 * bench::VertexCount(mesh));
  const double full = sweep(anew.context);
  const double vertices = bench::VertexCount(still);
  std::printf("%9.0f %12.2f %14.3f %14.4f %16.4f\n", vertices, 1e6 * first / std::max(1u, done),
              1e6 * full / vertices / 3, 1e6 * rest / vertices, 1e6 * rest);
}

// Seconds of the first sweep of a noisy sphere whose vertices and triangles lie at random in memory, and of a step
// after it in which all vertices grow; with tpa_reorder before, or without.
struct OrderTimes {
  double order, sweep, step;
};
OrderTimes TimesOf(const Mesh& scattered, bool ordered) {
  const tpa_remesh_options options = OptionsFor(MeanEdge(scattered), 1);
  const bench::Arena arena = Loaded(scattered, 2 * bench::VertexCount(scattered));
  tpa_issue issue{};
  OrderTimes times{};
  const auto order = [&] {
    const double start = Now();
    if (ordered && tpa_reorder(arena.context, &issue) != TPA_OK) Fail("reorder", issue);
    times.order = Now() - start;
  };
  const auto timed = [&](auto call, const char* name) {
    const double start = Now();
    if (call() != TPA_OK) Fail(name, issue);
    return Now() - start;
  };
  order();
  times.sweep = timed([&] { return tpa_remesh(arena.context, &options, nullptr, nullptr, &issue); }, "remesh");
  order();
  Mesh grown = MeshOf(arena.context);
  for (double& x : grown.positions) x *= 1 + 1e-4;
  tpa_move_input move{};
  move.struct_size = sizeof move;
  move.count = bench::VertexCount(grown);
  move.position_type = TPA_FLOAT64;
  move.positions = grown.positions.data();
  if (tpa_move(arena.context, &move, &issue) != TPA_OK) Fail("move", issue);
  times.step = timed([&] { return tpa_step(arena.context, nullptr, nullptr, &issue); }, "step");
  return times;
}

void PrintOrders(int levels) {
  const Mesh sphere = bench::Icosphere(levels, 1, 0);
  const Mesh scattered = bench::Shuffled(bench::Noisy(sphere, 0.2, 1), true, 1);
  const OrderTimes without = TimesOf(scattered, false), with = TimesOf(scattered, true);
  std::printf("%9u %9.3f %9.3f %9.3f %9.3f %9.3f\n", bench::VertexCount(sphere), with.order, without.sweep, with.sweep,
              without.step, with.step);
}

}  // namespace

int main(int argc, char** argv) {
  int repeats = 3;
  uint32_t sweeps = 5;
  std::vector<bench::NamedMesh> meshes;
  for (int i = 1; i < argc; ++i) {
    const std::string_view arg = argv[i];
    if (arg == "--repeats" && i + 1 < argc) {
      repeats = std::max(1, std::atoi(argv[++i]));
    } else if (arg == "--sweeps" && i + 1 < argc) {
      sweeps = static_cast<uint32_t>(std::max(1, std::atoi(argv[++i])));
    } else {
      Mesh mesh;
      if (tool::Status read = tool::read_mesh(argv[i], mesh); !read) {
        std::fprintf(stderr, "remesh_bench: %s\n", read.message.c_str());
        return 2;
      }
      const std::string path(arg);
      meshes.push_back({path.substr(path.rfind('/') + 1), Resolved(mesh)});
    }
  }
  if (meshes.empty())
    meshes = {{"sphere 10242", bench::Icosphere(5, 1, 0)},
              {"noisy sphere", bench::Noisy(bench::Icosphere(5, 1, 0), 0.2, 1)},
              {"knot 16000", bench::Knot(1000, 16)},
              {"graded 60", bench::Graded(60)}};
  std::printf("%u sweeps\n%-16s %4s %-5s %8s %8s  %5s %5s %5s  %5s %5s", sweeps, "mesh", "len", "", "seconds",
              "vertices", "least", "<30 %", "mean", "band", "dev.");
#ifdef BENCH_CGAL_REMESH
  std::printf("  %6s %6s  %5s", "mean d", "max d", "pairs");
#endif
  std::printf("\n");
  for (const bench::NamedMesh& mesh : meshes) Compare(mesh, repeats, sweeps);
  std::printf("\n%9s %12s %14s %14s %16s\n", "vertices", "us/operation", "us/tried, full", "us/vertex rest",
              "us, sweep at rest");
  for (const int levels : {5, 6, 7}) PrintCosts(levels);
  std::printf("\n%9s %9s %9s %9s %9s %9s\n", "scattered", "reorder", "sweep", "after", "step", "after");
  for (const int levels : {5, 6, 7, 8}) PrintOrders(levels);
}
