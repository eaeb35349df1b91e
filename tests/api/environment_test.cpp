// SPDX-License-Identifier: MIT
// The floating-point environment of the host: results have the same bits in all of them, and every call leaves the
// environment as it was, exception flags included.
#include <atomic>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <thread>

#include "support/host_environment.h"
#include "support/support.h"

namespace environment_test {
namespace {

using namespace support;

// Runs calls in a host's environment, one by one, and collects what they give.
class Host {
 public:
  explicit Host(const HostEnvironment& environment) : environment_(environment) {}

  void Call(const char* name, const std::function<tpa_status()>& call) {
    tpa_status status = TPA_OK;
    bool unchanged = false;
    {
      const Hosted hosted(environment_);
      status = call();
      unchanged = hosted.Unchanged();
    }
    EXPECT_TRUE(unchanged) << name << ", " << environment_.name;
    failures_ += status < 0 ? 1 : 0;
    Keep(status);
  }
  void Keep(const void* data, size_t size) { results_.append(static_cast<const char*>(data), size); }
  template <class T>
  void Keep(const T& value) {
    Keep(&value, sizeof value);
  }
  void KeepStateOf(const tpa_context* context) { results_ += Observe(context).bytes; }
  const std::string& results() const { return results_; }
  int failures() const { return failures_; }

 private:
  HostEnvironment environment_;
  std::string results_;
  int failures_ = 0;
};

Mesh TwoSpheres(double gap, int fineness) {
  return Together({Sphere({0, 0, 0}, 1, fineness), Sphere({2 + gap, .1, .2}, 1, fineness)});
}

std::vector<float> FloatsOf(const std::vector<double>& x) { return {x.begin(), x.end()}; }

void MakeAndLoad(Host& host, const Mesh& mesh, uint32_t detect_mode, std::unique_ptr<Arena>& arena) {
  tpa_config config = ConfigFor(mesh);
  config.detect_mode = detect_mode;
  config.cell_size = .3;
  arena = std::make_unique<Arena>(config);
  tpa_arena_size size;
  host.Call("tpa_arena_query", [&] { return tpa_arena_query(&config, &size, nullptr); });
  host.Keep(size);
  tpa_context* context = nullptr;
  host.Call("tpa_init", [&] { return tpa_init(arena->block(), arena->size().bytes, &config, &context, nullptr); });
  const std::vector<float> positions = FloatsOf(mesh.positions);
  tpa_mesh_input input = InputOf(mesh);
  input.position_type = TPA_FLOAT32;
  input.positions = positions.data();
  host.Call("tpa_load", [&] { return tpa_load(**arena, &input, nullptr); });
}

void Look(Host& host, tpa_context* context, const tpa_exec* exec) {
  auto contacts = Sized<tpa_contacts>();
  host.Call("tpa_detect", [&] { return tpa_detect(context, exec, &contacts, nullptr); });
  host.Keep(contacts.pairs, contacts.count * sizeof(tpa_contact));
  auto validation = Sized<tpa_validation>();
  host.Call("tpa_validate", [&] { return tpa_validate(context, exec, &validation, nullptr); });
  host.Keep(validation);
  constexpr uint32_t most = 10000;
  std::vector<float> floats(3 * most);
  auto output = Sized<tpa_mesh_output>();
  output.vertex_capacity = most;
  output.position_type = TPA_FLOAT32;
  output.positions = floats.data();
  host.Call("tpa_export", [&] { return tpa_export(context, &output, nullptr); });
  host.Keep(floats.data(), 3 * output.vertex_count * sizeof(float));
}

// Functions that leave the context alone.
void Read(Host& host, tpa_context* context) {
  const tpa_event* events = nullptr;
  const uint32_t* vertices = nullptr;
  uint32_t count = 0;
  auto view = Sized<tpa_mesh_view>();
  auto vertex_map = Sized<tpa_vertex_map_view>();
  auto triangle_map = Sized<tpa_triangle_map_view>();
  auto config = tpa_config{};
  tpa_memory_table tables[64];
  tpa_component components[16];
  auto changes = Sized<tpa_change_list>();
  char text[200];
  tpa_issue issue{};
  issue.status = TPA_E_CONFIG;
  host.Call("tpa_view", [&] { return tpa_view(context, &view); });
  host.Call("tpa_events", [&] { return tpa_events(context, &events, &count); });
  host.Call("tpa_rolled_back", [&] { return tpa_rolled_back(context, &vertices, &count); });
  host.Call("tpa_vertex_map", [&] { return tpa_vertex_map(context, &vertex_map); });
  host.Call("tpa_triangle_map", [&] { return tpa_triangle_map(context, &triangle_map); });
  host.Call("tpa_components", [&] { return tpa_components(context, components, 16, nullptr, &count, nullptr); });
  host.Keep(components, count * sizeof(tpa_component));
  host.Call("tpa_changes", [&] { return tpa_changes(context, &changes, nullptr); });
  std::vector<float> before(vertex_map.old_count, 0), after(vertex_map.new_count);
  for (size_t v = 0; v < before.size(); ++v) before[v] = 1 / (1 + static_cast<float>(v));
  host.Call("tpa_carry_vertices", [&] { return tpa_carry_vertices(context, before.data(), 1, after.data()); });
  host.Keep(after.data(), after.size() * sizeof(float));
  std::vector<float> of_faces(triangle_map.old_count, 1), carried(triangle_map.new_count);
  host.Call("tpa_carry_triangles", [&] { return tpa_carry_triangles(context, of_faces.data(), 1, carried.data()); });
  host.Call("tpa_memory_stats", [&] { return tpa_memory_stats(context, tables, 64, &count); });
  host.Call("tpa_config_init", [&] { return tpa_config_init(&config, sizeof config); });
  host.Keep(config);
  host.Call("tpa_issue_text", [&] { return static_cast<tpa_status>(tpa_issue_text(&issue, text, sizeof text)); });
  host.Call("tpa_status_string", [&] { return tpa_status_string(TPA_OK) != nullptr ? TPA_OK : TPA_E_STATE; });
  host.Call("tpa_version", [&] { return static_cast<tpa_status>(tpa_version()); });
}

void Step(Host& host, tpa_context* context, const Mesh& mesh, const tpa_exec* exec) {
  std::vector<float> targets = FloatsOf(mesh.positions);
  for (size_t i = targets.size() / 2; i < targets.size(); i += 3) targets[i] -= .35f;
  auto move = Sized<tpa_move_input>();
  move.count = VertexCount(mesh);
  move.position_type = TPA_FLOAT32;
  move.positions = targets.data();
  host.Call("tpa_move", [&] { return tpa_move(context, &move, nullptr); });
  auto report = Sized<tpa_report>();
  host.Call("tpa_step", [&] { return tpa_step(context, exec, &report, nullptr); });
  host.Keep(report);
  host.KeepStateOf(context);
}

void SaveAndGrow(Host& host, tpa_context* context) {
  auto config = Sized<tpa_config>();
  host.Call("tpa_config_of", [&] { return tpa_config_of(context, &config); });
  size_t size = 0;
  host.Call("tpa_save", [&] { return tpa_save(context, nullptr, 0, &size, nullptr); });
  std::vector<char> bytes(size);
  host.Call("tpa_save", [&] { return tpa_save(context, bytes.data(), size, &size, nullptr); });
  host.Keep(bytes.data(), bytes.size());
  host.Call("tpa_restore", [&] { return tpa_restore(context, bytes.data(), size, nullptr); });
  uint64_t digest = 0;
  host.Call("tpa_digest", [&] { return tpa_digest(context, &digest); });
  host.Keep(digest);
  config.max_vertices *= 2;
  Arena larger(config);
  tpa_context* grown = nullptr;
  host.Call("tpa_grow",
            [&] { return tpa_grow(context, larger.block(), larger.size().bytes, &config, &grown, nullptr); });
  uint32_t targets = 0;
  host.Call("tpa_reorder", [&] { return tpa_reorder(grown, nullptr); });
  host.Call("tpa_targets", [&] { return tpa_targets(grown, nullptr, nullptr, 0, &targets); });
  host.Call("tpa_drop_targets", [&] { return tpa_drop_targets(grown); });
  host.KeepStateOf(grown);
}

void RemeshAndSmooth(Host& host, tpa_context* context, double length, const tpa_exec* exec) {
  auto report = Sized<tpa_report>();
  auto remesh = Sized<tpa_remesh_options>();
  remesh.iterations = 2;
  remesh.target_length = length;
  remesh.relaxation = .5;
  host.Call("tpa_remesh", [&] { return tpa_remesh(context, &remesh, exec, &report, nullptr); });
  host.Keep(report);
  host.KeepStateOf(context);
  auto smooth = Sized<tpa_smooth_options>();
  smooth.iterations = 3;
  host.Call("tpa_smooth", [&] { return tpa_smooth(context, &smooth, exec, &report, nullptr); });
  host.Keep(report);
  host.KeepStateOf(context);
}

void Adapt(Host& host, tpa_context* context, const tpa_exec* exec) {
  auto report = Sized<tpa_report>();
  host.Call("tpa_adapt", [&] { return tpa_adapt(context, exec, &report, nullptr); });
  host.Keep(report);
  host.KeepStateOf(context);
}

void Handles(Host& host) {
  const uint32_t sides[3] = {5, 4, 3};
  uint32_t faces[3 * TPA_HANDLE_MAX_FACES] = {};
  uint64_t orbit = 0;
  auto info = Sized<tpa_handle_info>();
  host.Call("tpa_handle_describe", [&] { return tpa_handle_describe(3, sides, &info); });
  host.Call("tpa_handle_get", [&] { return tpa_handle_get(3, sides, 17, faces, 3 * TPA_HANDLE_MAX_FACES); });
  host.Keep(faces);
  host.Call("tpa_handle_generator",
            [&] { return tpa_handle_generator(3, sides, 1, faces, 3 * TPA_HANDLE_MAX_FACES, &orbit); });
  host.Keep(faces);
}

// All calls on a merge, on a mesh that is tangled, and in both modes of detection.
std::string ResultsIn(const HostEnvironment& environment, int fineness, const tpa_exec* exec = nullptr) {
  Host host(environment);
  const Mesh apart = TwoSpheres(.125, fineness), tangled = TwoSpheres(-.3, fineness);
  std::unique_ptr<Arena> arena;
  MakeAndLoad(host, apart, TPA_DETECT_COMPLETE, arena);
  Look(host, **arena, exec);
  Step(host, **arena, apart, exec);
  SaveAndGrow(host, **arena);
  Look(host, **arena, exec);
  RemeshAndSmooth(host, **arena, 1.8 / fineness, exec);
  Read(host, **arena);
  for (uint32_t mode : {TPA_DETECT_VERTEX_HASH, TPA_DETECT_COMPLETE}) {
    MakeAndLoad(host, tangled, mode, arena);
    Look(host, **arena, exec);
    Adapt(host, **arena, exec);
  }
  host.Call("tpa_reset", [&] { return tpa_reset(**arena); });
  Handles(host);
  EXPECT_EQ(host.failures(), 0);
  return host.results();
}

TEST(Environment, TheSameBitsInEveryEnvironmentWhichStaysAsItWas) {
  const std::string expected = ResultsIn({}, 4);
  ASSERT_GT(expected.size(), 50000u);
  for (const HostEnvironment& e : HostEnvironments())
    if (e.name != "nearest, traps 0, no flags") {
      EXPECT_TRUE(ResultsIn(e, 4) == expected) << e.name;
    }
}

// ---------------------------------------------------------------- threads with environments of their own

struct Workers {
  HostEnvironment environment;
  std::atomic<int> changed{0}, tasks{0};
};

void OnThreads(void* user, uint32_t count, void (*task)(void*, uint32_t), void* data) {
  Workers& workers = *static_cast<Workers*>(user);
  const auto some = [&](uint32_t first) {
    const Hosted hosted(workers.environment);
    for (uint32_t i = first; i < count; i += 2) {
      task(data, i);
      if (!hosted.Unchanged()) ++workers.changed;
      ++workers.tasks;
    }
  };
  std::thread other(some, 1u);
  some(0);
  other.join();
}

// On meshes of many vertices, which are smoothed in several tasks.
TEST(Environment, TasksToo) {
  const std::string expected = ResultsIn({}, 12);
  for (const HostEnvironment& e : {HostEnvironment{"up", FE_UPWARD},
                                   HostEnvironment{"flush", FE_TONEAREST, 0, HasFlush()}, HostEnvironments().back()}) {
    Workers workers{e, {}, {}};
    auto exec = Sized<tpa_exec>();
    exec.user = &workers;
    exec.parallel_for = OnThreads;
    EXPECT_TRUE(ResultsIn(e, 12, &exec) == expected) << e.name;
    EXPECT_GT(workers.tasks, 10);
    EXPECT_EQ(workers.changed, 0) << e.name;
  }
}

// ---------------------------------------------------------------- numbers that raise exceptions when looked at

TEST(Environment, NumbersThatAreRefusedTrapNothing) {
  const HostEnvironment all = HostEnvironments().back();
  Host host(all);
  const Mesh mesh = Sphere({0, 0, 0}, 1, 4);
  Arena arena(ConfigFor(mesh), mesh);
  const Observed before = Observe(*arena);
  const uint32_t signaling_nan = 0x7FA00000;
  std::vector<float> floats = FloatsOf(mesh.positions);
  std::memcpy(&floats[4], &signaling_nan, sizeof signaling_nan);
  tpa_issue issue;
  tpa_mesh_input input = InputOf(mesh);
  input.position_type = TPA_FLOAT32;
  input.positions = floats.data();
  host.Call("tpa_load", [&] { return tpa_load(*arena, &input, &issue); });
  EXPECT_EQ(issue.status, TPA_E_MESH);
  EXPECT_EQ(issue.defect, TPA_DEFECT_NOT_FINITE);
  auto move = Sized<tpa_move_input>();
  move.count = VertexCount(mesh);
  move.position_type = TPA_FLOAT32;
  move.positions = floats.data();
  host.Call("tpa_move", [&] { return tpa_move(*arena, &move, &issue); });
  EXPECT_EQ(issue.status, TPA_E_MESH);
  tpa_config config = DefaultConfig(100);
  tpa_arena_size size;
  config.cell_size = std::numeric_limits<double>::signaling_NaN();
  host.Call("tpa_arena_query", [&] { return tpa_arena_query(&config, &size, &issue); });
  EXPECT_EQ(issue.status, TPA_E_CONFIG);
  auto remesh = Sized<tpa_remesh_options>();
  remesh.iterations = 1;
  for (double length : {std::numeric_limits<double>::quiet_NaN(), 1e300, 1e-310}) {
    remesh.target_length = length;
    remesh.split_ratio = 1e300;
    host.Call("tpa_remesh", [&] { return tpa_remesh(*arena, &remesh, nullptr, nullptr, &issue); });
    EXPECT_EQ(issue.status, TPA_E_ARGUMENT);
  }
  EXPECT_EQ(host.failures(), 6);
  EXPECT_TRUE(Observe(*arena) == before);
}

}  // namespace
}  // namespace environment_test
