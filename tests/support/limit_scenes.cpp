// SPDX-License-Identifier: MIT
#include "support/limit_scenes.h"

#include <gtest/gtest.h>

#include "support/field_shapes.h"
#include "support/step_scenes.h"
#include "support/tangle_shapes.h"

namespace support {

tpa_config WithLimits(tpa_config config, const Limits7& limits) {
  for (size_t i = 0; i < limits.size(); ++i) config.*limit_fields[i] = limits[i];
  return config;
}

std::vector<tpa_memory_table> TablesOf(const tpa_context* context) {
  uint32_t count = 0;
  EXPECT_EQ(tpa_memory_stats(context, nullptr, 0, &count), TPA_OK);
  std::vector<tpa_memory_table> tables(count);
  EXPECT_EQ(tpa_memory_stats(context, tables.data(), count, &count), TPA_OK);
  return tables;
}

Limits7 PeaksOf(const tpa_context* context) {
  const std::vector<tpa_memory_table> tables = TablesOf(context);
  Limits7 peaks = least_limits;
  for (size_t i = 0; i < peaks.size(); ++i) {
    const auto is_it = [&](const tpa_memory_table& t) { return std::string(t.name) == limit_tables[i]; };
    const auto table = std::find_if(tables.begin(), tables.end(), is_it);
    if (table == tables.end())
      ADD_FAILURE() << "no table is called " << limit_tables[i];
    else
      peaks[i] = std::max(peaks[i], static_cast<uint32_t>(table->peak));
  }
  return peaks;
}

namespace {

// ---------------------------------------------------------------- random scenes

Mesh RandomMesh(Random& random) {
  switch (WholeIn(random, 0, 5)) {
    case 0: return Sphere({}, 1, WholeIn(random, 3, 5));
    case 1: return Torus({}, 1, 0.4, WholeIn(random, 8, 14), WholeIn(random, 5, 8));
    case 2: return Slab(2, 2, 0.5, Uniform(random, 0.4, 0.7));
    case 3: return Noisy(Sphere({}, 1, 3), Uniform(random, 0.05, 0.4), random);
    case 4: return RandomlyTurned(Box({-1, -1, -1}, {1, 1, 1}, WholeIn(random, 2, 4)), random);
    default: return ThinBody(random);
  }
}

Mesh RandomMeshes(Random& random) {
  std::vector<Mesh> parts = {RandomMesh(random)};
  for (int more = WholeIn(random, 0, 2); more > 0; --more)
    parts.push_back(Translated(RandomMesh(random), RandomPoint(random, -1.6, 1.6)));
  return Together(parts);
}

CallKind RandomKind(Random& random) {
  const CallKind kinds[] = {CallKind::step,   CallKind::step,  CallKind::step,   CallKind::step,   CallKind::step,
                            CallKind::remesh, CallKind::adapt, CallKind::smooth, CallKind::detect, CallKind::validate};
  return kinds[WholeIn(random, 0, 9)];
}

// ---------------------------------------------------------------- calls

template <class T>
void Append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Noise, or parts that move together across each other.
std::vector<double> RandomTargets(const Mesh& m, Random& random) {
  const double edge = MeanEdgeOf(m);
  if (Coin(random)) return ShakenTargets(m, Uniform(random, 0.05, 0.9) * edge, random);
  const Point from = RandomPoint(random, -0.3, 0.3), way = RandomDirection(random);
  const double far = Uniform(random, 0.5, 4) * edge;
  return TargetsOf(m, [&](const Point& p) {
    double side = 0;
    for (size_t i = 0; i < 3; ++i) side += (p[i] - from[i]) * way[i];
    Point to = p;
    for (size_t i = 0; i < 3; ++i) to[i] -= (side > 0 ? far : -far) * way[i];
    return to;
  });
}

}  // namespace

tpa_status MakeCall(tpa_context* context, const CallScene& scene, const CallOf& call, const tpa_exec* exec,
                    std::string& bytes, tpa_issue* issue) {
  Random random(call.seed);
  auto report = Sized<tpa_report>();
  tpa_status status = TPA_OK;
  switch (call.kind) {
    case CallKind::load: return Load(context, scene.mesh, issue);
    case CallKind::adapt: status = tpa_adapt(context, exec, &report, issue); break;
    case CallKind::step:
      EXPECT_EQ(MoveAll(context, RandomTargets(MeshOf(context), random)), TPA_OK);
      status = tpa_step(context, exec, &report, issue);
      break;
    case CallKind::remesh: {
      auto options = Sized<tpa_remesh_options>();
      options.iterations = static_cast<uint32_t>(WholeIn(random, 1, 4));
      options.target_length = Uniform(random, 0.3, 1.5) * MeanEdgeOf(MeshOf(context));
      options.relaxation = Coin(random) ? 0 : 0.5;
      status = tpa_remesh(context, &options, exec, &report, issue);
      break;
    }
    case CallKind::smooth: {
      auto options = Sized<tpa_smooth_options>();
      options.iterations = 2;
      std::vector<uint32_t> half;
      for (uint32_t v = 0; v < VertexCount(MeshOf(context)) / 2; ++v) half.push_back(v);
      if (Coin(random)) {
        options.vertices = half.data();
        options.count = static_cast<uint32_t>(half.size());
      }
      status = tpa_smooth(context, &options, exec, &report, issue);
      break;
    }
    case CallKind::detect: {
      auto contacts = Sized<tpa_contacts>();
      status = tpa_detect(context, exec, &contacts, issue);
      if (status == TPA_OK)
        bytes.append(reinterpret_cast<const char*>(contacts.pairs), sizeof(tpa_contact) * contacts.count);
      return status;
    }
    case CallKind::validate: {
      auto validation = Sized<tpa_validation>();
      status = tpa_validate(context, exec, &validation, issue);
      Append(bytes, validation);
      return status;
    }
  }
  Append(bytes, report);
  return status;
}

CallScene RandomCallScene(uint64_t seed) {
  Random random(seed);
  CallScene scene{"calls-" + std::to_string(seed), RandomMeshes(random), {{CallKind::load, 0}}, 0};
  if (Coin(random)) scene.calls.push_back({CallKind::detect, 0});
  scene.calls.push_back({CallKind::adapt, 0});
  for (int more = WholeIn(random, 1, 5); more > 0; --more) scene.calls.push_back({RandomKind(random), random()});
  return scene;
}

CallScene SceneOf(std::string name, Mesh mesh, CallKind kind, uint64_t seed) {
  return {std::move(name), std::move(mesh), {{CallKind::load, 0}, {kind, seed}}, 0};
}

CallScene Hashed(CallScene scene) {
  scene.name += "-hashed";
  scene.cell = MeanEdgeOf(scene.mesh);
  return scene;
}

tpa_config AmpleLimits(const CallScene& scene) {
  const Mesh& m = scene.mesh;
  tpa_config config = DefaultConfig(8 * VertexCount(m) + 1024);
  config.max_triangles = 2 * config.max_vertices + 1024;
  config.max_contacts = 16 * TriangleCount(m);
  config.max_cut_edges = 6 * TriangleCount(m);
  config.max_events = VertexCount(m) + 256;
  config.max_components = config.max_vertices / 3;
  config.max_pieces = 6 * config.max_contacts + 1024;
  if (scene.cell > 0) {
    config.detect_mode = TPA_DETECT_VERTEX_HASH;
    config.cell_size = scene.cell;
  }
  return config;
}

CallsEnded Play(const CallScene& scene, const tpa_config& config) {
  CallsEnded out;
  const Arena arena(config);
  for (const CallOf& call : scene.calls) {
    CallEnded ended{};
    const Observed before = Observe(*arena);
    ended.status = MakeCall(*arena, scene, call, nullptr, ended.bytes, &ended.issue);
    const Observed after = Observe(*arena);
    out.failure_changed = out.failure_changed || (ended.status != TPA_OK && !(after == before));
    ended.bytes += after.bytes;
    out.calls.push_back(std::move(ended));
    if (out.limited()) break;
  }
  out.peaks = PeaksOf(*arena);
  return out;
}

}  // namespace support
