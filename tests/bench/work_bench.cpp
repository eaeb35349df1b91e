// SPDX-License-Identifier: MIT
// work_bench: units of work (tpa_exec) per second, for calls of all kinds on ordinary and on hard meshes.
//
//   work_bench [--budget MILLIONS] [--only PART_OF_A_NAME]
//
// Each call has a budget; hard ones spend it, and show the time after which they end. The last column is to vary
// little: a budget bounds time no better than that.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <numeric>
#include <random>
#include <string_view>

#include "stepping.h"

namespace {

using namespace bench;

struct Options {
  uint64_t budget = 20000000;
  std::string_view only;
};

using Random = std::mt19937_64;
double Uniform(Random& random, double low, double high) {
  return low + (high - low) * static_cast<double>(random() >> 11) * 0x1p-53;
}

// ---------------------------------------------------------------- meshes

Mesh Moved(Mesh m, double x, double y, double z) {
  const double by[3] = {x, y, z};
  for (size_t i = 0; i < m.positions.size(); ++i) m.positions[i] += by[i % 3];
  return m;
}

Mesh RandomPositions(int levels) {
  Mesh m = Icosphere(levels, 1, 0);
  Random random(1);
  for (double& x : m.positions) x = Uniform(random, -1, 1);
  return m;
}

// Two vertices with so many triangles each.
Mesh Hub(uint32_t valence) {
  Mesh m;
  m.positions = {0, 0, .5, 0, 0, -.5};
  for (uint32_t i = 0; i < valence; ++i) {
    const double angle = 6.283185307179586 * i / valence;
    m.positions.insert(m.positions.end(), {std::cos(angle), std::sin(angle), 0});
    const uint32_t a = 2 + i, b = 2 + (i + 1) % valence;
    m.triangles.insert(m.triangles.end(), {0, a, b, 1, b, a});
  }
  return m;
}

Mesh Cube(double x, double y, double z, double sx, double sy, double sz) {
  Mesh m;
  for (int i = 0; i < 8; ++i)
    m.positions.insert(m.positions.end(), {x + (i & 1) * sx, y + (i >> 1 & 1) * sy, z + (i >> 2 & 1) * sz});
  m.triangles = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  return m;
}

Mesh HeapOfCubes(int count) {
  Mesh m;
  Random random(1);
  for (int i = 0; i < count; ++i)
    Append(m, Cube(Uniform(random, -1, 1), Uniform(random, -1, 1), Uniform(random, -1, 1), .5, .5, .5), false);
  return m;
}

Mesh NearlyUponEachOther(int count) {
  Mesh m;
  for (int i = 0; i < count; ++i) Append(m, Cube(.01 * i, .013 * i, 0, 2, 2, .1 + .001 * i), false);
  return m;
}

Mesh Apart(int levels, double between) {
  Mesh m = Icosphere(levels, 1, 0);
  Append(m, Moved(Icosphere(levels, 1, 0), 2 + between, .01, .02), false);
  return m;
}

// Equal balls side by side in a square.
Mesh Balls(int count) {
  Mesh m;
  for (int i = 0; i < count; ++i) Append(m, Moved(Icosphere(2, .49, 0), i % 8, i / 8, 0), false);
  return m;
}

// Boxes of the same height, each shifted within the planes of the one before.
Mesh Shifted(int count) {
  Mesh m;
  for (int i = 0; i < count; ++i) Append(m, Cube(.25 * i, .125 * i, 0, 1, 1, 1), false);
  return m;
}

// ---------------------------------------------------------------- calls

using Call = std::function<tpa_status(tpa_context*, const tpa_exec*, tpa_issue*)>;

tpa_status Detect(tpa_context* context, const tpa_exec* exec, tpa_issue* issue) {
  tpa_contacts contacts{};
  contacts.struct_size = sizeof contacts;
  return tpa_detect(context, exec, &contacts, issue);
}

tpa_status Adapt(tpa_context* context, const tpa_exec* exec, tpa_issue* issue) {
  return tpa_adapt(context, exec, nullptr, issue);
}

tpa_status Smooth(tpa_context* context, const tpa_exec* exec, tpa_issue* issue) {
  tpa_smooth_options options{};
  options.struct_size = sizeof options;
  options.iterations = 10;
  return tpa_smooth(context, &options, exec, nullptr, issue);
}

Call Remesh(double ratio, double relaxation) {
  return [=](tpa_context* context, const tpa_exec* exec, tpa_issue* issue) {
    const tpa_mesh_view view = ViewOf(context);
    Mesh m;
    m.positions.assign(view.positions, view.positions + 3 * size_t{view.vertex_count});
    m.triangles.assign(view.triangles, view.triangles + 3 * size_t{view.triangle_count});
    tpa_remesh_options options{};
    options.struct_size = sizeof options;
    options.iterations = 3;
    options.target_length = ratio * MeanEdge(m);
    options.relaxation = relaxation;
    return tpa_remesh(context, &options, exec, nullptr, issue);
  };
}

tpa_status Step(tpa_context* context, const tpa_exec* exec, tpa_issue* issue) {
  return tpa_step(context, exec, nullptr, issue);
}

tpa_status Advance(tpa_context* context, const tpa_exec* exec, tpa_issue* issue) {
  return tpa_advance(context, .03, exec, nullptr, issue);
}

tpa_status Validate(tpa_context* context, const tpa_exec* exec, tpa_issue* issue) {
  tpa_validation validation{};
  validation.struct_size = sizeof validation;
  return tpa_validate(context, exec, &validation, issue);
}

// The first hundred vertices alone.
tpa_status SmoothPart(tpa_context* context, const tpa_exec* exec, tpa_issue* issue) {
  std::vector<uint32_t> first(100);
  std::iota(first.begin(), first.end(), 0u);
  tpa_smooth_options options{};
  options.struct_size = sizeof options;
  options.iterations = 10;
  options.vertices = first.data();
  options.count = static_cast<uint32_t>(first.size());
  return tpa_smooth(context, &options, exec, nullptr, issue);
}

struct Scene {
  const char* name;
  Mesh mesh;
  Call call;
  std::vector<double> targets;
  double cell = 0;
};

std::vector<double> Targets(const Mesh& m, const std::function<void(double*)>& move) {
  std::vector<double> out = m.positions;
  for (size_t i = 0; i < out.size(); i += 3) move(&out[i]);
  return out;
}

std::vector<double> Shaken(const Mesh& m, double edges) {
  Random random(1);
  const double far = edges * MeanEdge(m);
  std::vector<double> out = m.positions;
  for (double& x : out) x += Uniform(random, -far, far);
  return out;
}

// The first `count` vertices move.
std::vector<double> Lifted(const Mesh& m, size_t count, double by) {
  std::vector<double> out = m.positions;
  for (size_t i = 0; i < 3 * count; ++i) out[i] *= 1 + by;
  return out;
}

void ForEachDetection(const std::function<void(const Scene&)>& play) {
  const Mesh sphere = Icosphere(5, 1, 0);
  play({"detect, sphere", sphere, Detect, {}});
  play({"detect, shuffled sphere", Shuffled(sphere, true, 1), Detect, {}});
  play({"detect, two spheres", TwoSpheres(5), Detect, {}});
  play({"detect, ten shells", NestedShells(3, 10), Detect, {}});
  play({"detect, knot", Knot(400, 24), Detect, {}});
  play({"detect, noisy torus", Noisy(Torus(160, 60), .5, 1), Detect, {}});
  play({"detect, graded", Graded(60), Detect, {}});
  play({"detect, hub", Hub(10000), Detect, {}});
  play({"detect, random positions", RandomPositions(3), Detect, {}});
  play({"detect, two spheres, hash", TwoSpheres(5), Detect, {}, .03});
  play({"validate, sphere", sphere, Validate, {}});
}

void ForEachMove(const std::function<void(const Scene&)>& play) {
  const Mesh sphere = Icosphere(5, 1, 0), apart = Apart(5, .01), coarse = Apart(1, .01), hub = Hub(10000);
  const Mesh graded = Graded(60), balls = Balls(70);
  const auto shift = [](double* p) { p[0] += .01, p[1] += .01, p[2] += .01; };
  const auto together = [](double* p) { p[0] += p[0] < 1 ? .03 : -.03; };
  const auto closer = [](double* p) { p[0] *= .9, p[1] *= .9; };
  const auto to_point = [](double* p) { p[0] = p[1] = p[2] = 0; };
  play({"step, no contact", sphere, Step, Targets(sphere, shift)});
  play({"step, one vertex", sphere, Step, Lifted(sphere, 1, .01)});
  play({"step, a hundred vertices", sphere, Step, Lifted(sphere, 100, .01)});
  play({"step, graded", graded, Step, Targets(graded, shift)});
  play({"step, two bodies meet", apart, Step, Targets(apart, together)});
  play({"step, coarse bodies meet", coarse, Step, Targets(coarse, together)});
  play({"step, seventy balls meet", balls, Step, Targets(balls, closer)});
  play({"step, they meet, hash", apart, Step, Targets(apart, together), .03});
  play({"step, hub", hub, Step, Targets(hub, shift)});
  play({"step, noise of .3 edges", sphere, Step, Shaken(sphere, .3)});
  play({"step, noise of 1 edge", sphere, Step, Shaken(sphere, 1)});
  const Mesh ball = Icosphere(3, 1, 0);
  play({"step, ball to a point", ball, Step, Targets(ball, to_point)});
  play({"advance, no contact", sphere, Advance, Targets(sphere, closer)});
  play({"advance, two bodies meet", apart, Advance, Targets(apart, together)});
}

void ForEachEdit(const std::function<void(const Scene&)>& play) {
  const Mesh sphere = Icosphere(5, 1, 0);
  play({"adapt, sphere", sphere, Adapt, {}});
  play({"adapt, two spheres", TwoSpheres(5), Adapt, {}});
  play({"adapt, ten shells", NestedShells(3, 10), Adapt, {}});
  play({"adapt, knot", Knot(400, 24), Adapt, {}});
  play({"adapt, noisy torus", Noisy(Torus(160, 60), .5, 1), Adapt, {}});
  play({"adapt, heap of cubes", HeapOfCubes(375), Adapt, {}});
  play({"adapt, boxes upon boxes", NearlyUponEachOther(30), Adapt, {}});
  play({"adapt, boxes shifted", Shifted(12), Adapt, {}});
  play({"adapt, random positions", RandomPositions(3), Adapt, {}});
  play({"remesh, finer", sphere, Remesh(.5, .5), {}});
  play({"remesh, coarser", sphere, Remesh(2, .5), {}});
  play({"remesh, graded", Graded(60), Remesh(1, .5), {}});
  play({"remesh, hub", Hub(1000), Remesh(1, 0), {}});
  play({"smooth, sphere", sphere, Smooth, {}});
  play({"smooth, a hundred vertices", sphere, SmoothPart, {}});
  play({"smooth, noisy torus", Noisy(Torus(160, 60), .1, 1), Smooth, {}});
  play({"smooth, hub", Hub(4900), Smooth, {}});
}

void ForEachScene(const std::function<void(const Scene&)>& play) {
  ForEachDetection(play);
  ForEachMove(play);
  ForEachEdit(play);
}

struct Measured {
  tpa_status status;
  double nanoseconds;  // of a unit
};

// `large`: limits for hard meshes. Else the block is no larger than most calls want, and a copy of it leaves its pages
// in the caches, as they are in a loop of frames.
tpa_config ConfigOf(const Scene& scene, bool large) {
  tpa_config config = ConfigFor(scene.mesh);
  config.max_vertices = 2 * VertexCount(scene.mesh) + 1000;
  config.max_substeps = 64;
  if (large) {
    config.max_vertices = 8 * VertexCount(scene.mesh) + 40000;
    config.max_contacts = 2000000;
    config.max_cut_edges = 200000;
    config.max_events = 50000;
    config.max_components = 12000;
  }
  if (scene.cell > 0) {
    config.detect_mode = TPA_DETECT_VERTEX_HASH;
    config.cell_size = scene.cell;
  }
  return config;
}

void Prepare(const Scene& scene, const Arena& arena) {
  tpa_issue issue = arena.issue;
  if (arena.context == nullptr) Fail("tpa_init", issue);
  const tpa_mesh_input input = InputOf(scene.mesh);
  Check(tpa_load(arena.context, &input, &issue), "tpa_load", issue);
  if (scene.targets.empty()) return;
  tpa_contacts contacts{};
  contacts.struct_size = sizeof contacts;
  Check(tpa_detect(arena.context, nullptr, &contacts, &issue), "tpa_detect", issue);
  tpa_move_input move{};
  move.struct_size = sizeof move;
  move.count = VertexCount(scene.mesh);
  move.position_type = TPA_FLOAT64;
  move.positions = scene.targets.data();
  Check(tpa_move(arena.context, &move, &issue), "tpa_move", issue);
}

// The shortest of five calls from the same state.
Measured Measure(const Scene& scene, const Options& o, bool large) {
  const Arena arena(ConfigOf(scene, large));
  Prepare(scene, arena);
  uint64_t units = 0;
  tpa_exec exec{};
  exec.struct_size = sizeof exec;
  exec.budget = o.budget;
  exec.progress = &units;
  const std::vector<char> state(static_cast<const char*>(arena.block.get()),
                                static_cast<const char*>(arena.block.get()) + arena.bytes);
  double seconds = HUGE_VAL;
  tpa_status status = TPA_OK;
  for (int i = 0; i < 5; ++i) {
    std::memcpy(arena.block.get(), state.data(), state.size());
    tpa_issue issue{};
    const double start = Now();
    status = scene.call(arena.context, &exec, &issue);
    seconds = std::min(seconds, Now() - start);
    if (status == TPA_E_LIMIT && !large) return {status, 0};
  }
  const double nanoseconds = 1e9 * seconds / static_cast<double>(units);
  std::printf("%-26s %8u %10.3f %10llu %8.1f  %s\n", scene.name, VertexCount(scene.mesh), 1e3 * seconds,
              static_cast<unsigned long long>(units), nanoseconds, status == TPA_OK ? "" : tpa_status_string(status));
  std::fflush(stdout);
  return {status, nanoseconds};
}

}  // namespace

int main(int argc, char** argv) {
  Options o;
  for (int i = 1; i + 1 < argc; i += 2) {
    if (std::strcmp(argv[i], "--budget") == 0) o.budget = static_cast<uint64_t>(1e6 * std::atof(argv[i + 1]));
    if (std::strcmp(argv[i], "--only") == 0) o.only = argv[i + 1];
  }
  std::printf("%-26s %8s %10s %10s %8s\n", "call", "vertices", "ms", "units", "ns each");
  double least = HUGE_VAL, most = 0;
  ForEachScene([&](const Scene& scene) {
    if (std::string_view(scene.name).find(o.only) == std::string_view::npos) return;
    Measured m = Measure(scene, o, false);
    if (m.status == TPA_E_LIMIT) m = Measure(scene, o, true);
    least = std::min(least, m.nanoseconds);
    most = std::max(most, m.nanoseconds);
  });
  std::printf("A unit takes %.1f to %.1f ns.\n", least, most);
}
