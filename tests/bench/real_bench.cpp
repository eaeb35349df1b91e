// SPDX-License-Identifier: MIT
// real_bench: tpa_load, tpa_adapt, a step and a sweep of tpa_remesh on real meshes, beside even ones of about as many
// triangles and beside hubs. Nanoseconds per triangle, the least of all runs; "-" where the call refuses.
//
//   real_bench [--shared FOLDER] [--repeats N] [--only TEXT]
//
// In the step each vertex moves along its normal by a tenth of its shortest edge. The sweep aims at the mean edge. Both
// start from the mesh that tpa_adapt leaves.
#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>

#include "real_meshes.h"
#include "stepping.h"

namespace {

using namespace bench;

struct Options {
  std::string shared = "../shared", only;
  int repeats = 3;
};

// Two cones over a ring: hubs of `valence` faces.
Mesh Hubs(int valence) {
  Mesh m;
  for (int i = 0; i < valence; ++i) {
    const double turn = 6.283185307179586 * i / valence;
    m.positions.insert(m.positions.end(), {std::cos(turn), std::sin(turn), 0});
  }
  m.positions.insert(m.positions.end(), {0, 0, .5, 0, 0, -.5});
  const uint32_t n = static_cast<uint32_t>(valence);
  for (uint32_t i = 0; i < n; ++i) m.triangles.insert(m.triangles.end(), {i, (i + 1) % n, n, (i + 1) % n, i, n + 1});
  return m;
}

// Targets along the normals, a tenth of the shortest edge away.
std::vector<double> Grown(const tpa_mesh_view& view) {
  const size_t n = view.vertex_count;
  std::vector<double> normals(3 * n), shortest(n, 1e300), targets(view.positions, view.positions + 3 * n);
  for (size_t h = 0; h < 3 * size_t{view.triangle_count}; h += 3) {
    const uint32_t* v = view.triangles + h;
    const auto edge = [&](size_t i, size_t k) {
      return view.positions[3 * size_t{v[(i + 1) % 3]} + k] - view.positions[3 * size_t{v[i]} + k];
    };
    for (size_t i = 0; i < 3; ++i) {
      const double size = std::hypot(edge(i, 0), edge(i, 1), edge(i, 2));
      for (const uint32_t end : {v[i], v[(i + 1) % 3]}) shortest[end] = std::min(shortest[end], size);
      for (size_t k = 0; k < 3; ++k) {
        const size_t y = (k + 1) % 3, z = (k + 2) % 3;
        normals[3 * size_t{v[i]} + k] += edge(0, y) * edge(1, z) - edge(0, z) * edge(1, y);
      }
    }
  }
  for (size_t v = 0; v < n; ++v) {
    const double* normal = &normals[3 * v];
    const double size = std::hypot(normal[0], normal[1], normal[2]);
    for (size_t k = 0; k < 3 && size > 0; ++k) targets[3 * v + k] += .1 * shortest[v] / size * normal[k];
  }
  return targets;
}

// Seconds of a call, or a negative number where it refuses.
template <class Call>
double TimeOf(Call call) {
  const double start = Now();
  return call() == TPA_OK ? Now() - start : -1;
}

enum Work { loading, adapting, stepping, remeshing, works };

struct Times {
  double best[works] = {-1, -1, -1, -1};
  void Note(Work work, double seconds) {
    if (seconds >= 0 && (best[work] < 0 || seconds < best[work])) best[work] = seconds;
  }
};

double StepOf(tpa_context* context, const std::vector<double>& targets) {
  tpa_issue issue{};
  tpa_move_input move{};
  move.struct_size = sizeof move;
  move.count = static_cast<uint32_t>(targets.size() / 3);
  move.position_type = TPA_FLOAT64;
  move.positions = targets.data();
  tpa_report report{};
  report.struct_size = sizeof report;
  Check(tpa_move(context, &move, &issue), "tpa_move", issue);
  return TimeOf([&] { return tpa_step(context, nullptr, &report, &issue); });
}

double RemeshOf(tpa_context* context, double length) {
  tpa_issue issue{};
  tpa_remesh_options options{};
  options.struct_size = sizeof options;
  options.iterations = 1;
  options.target_length = length;
  options.relaxation = .5;
  tpa_report report{};
  report.struct_size = sizeof report;
  return TimeOf([&] { return tpa_remesh(context, &options, nullptr, &report, &issue); });
}

// One run; false where the mesh is refused.
bool Run(tpa_context* context, const Mesh& mesh, Times& times) {
  tpa_issue issue{};
  const tpa_mesh_input input = InputOf(mesh);
  tpa_report report{};
  report.struct_size = sizeof report;
  const double load = TimeOf([&] { return tpa_load(context, &input, &issue); });
  if (load < 0) return false;
  times.Note(loading, load);
  times.Note(adapting, TimeOf([&] { return tpa_adapt(context, nullptr, &report, &issue); }));
  times.Note(stepping, StepOf(context, Grown(ViewOf(context))));
  Check(tpa_load(context, &input, &issue), "tpa_load", issue);
  tpa_adapt(context, nullptr, &report, &issue);
  times.Note(remeshing, RemeshOf(context, MeanEdge(mesh)));
  return true;
}

void Row(const NamedMesh& named, const Options& o) {
  if (named.name.find(o.only) == std::string::npos) return;
  tpa_config config = ConfigFor(named.mesh);
  config.max_vertices = 4 * VertexCount(named.mesh) + 10000;
  config.max_contacts = 16 * TriangleCount(named.mesh) + 10000;
  const Arena arena(config);
  tpa_issue issue = arena.issue;
  if (arena.context == nullptr) Fail("tpa_init", issue);
  Times times;
  for (int i = 0; i < o.repeats; ++i)
    if (!Run(arena.context, named.mesh, times)) return;
  std::printf("%-16s %9u", named.name.c_str(), TriangleCount(named.mesh));
  for (const double seconds : times.best)
    if (seconds < 0)
      std::printf(" %9s", "-");
    else
      std::printf(" %9.0f", 1e9 * seconds / TriangleCount(named.mesh));
  std::printf("\n");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  for (int i = 1; i + 1 < argc; i += 2) {
    const std::string_view arg = argv[i];
    if (arg == "--shared") o.shared = argv[i + 1];
    if (arg == "--only") o.only = argv[i + 1];
    if (arg == "--repeats") o.repeats = std::max(1, std::atoi(argv[i + 1]));
  }
  std::printf("%-16s %9s %9s %9s %9s %9s\n", "mesh", "triangles", "load", "adapt", "step", "remesh");
  for (const int levels : {4, 5, 6}) Row({"even-" + std::to_string(levels), Icosphere(levels, 1, 0)}, o);
  for (const NamedMesh& named : FilesIn(o.shared)) Row(named, o);
  for (const NamedMesh& named : RealMeshes(o.only)) Row(named, o);
  for (const int valence : {1000, 2000, 4000}) Row({"hubs-" + std::to_string(valence), Hubs(valence)}, o);
}
