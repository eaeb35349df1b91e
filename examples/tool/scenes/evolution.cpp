// SPDX-License-Identifier: MIT
#include "tool/scenes/evolution.h"

#include <algorithm>
#include <chrono>

namespace tool {

namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// Numbers of each vertex, carried along when the mesh changes.
struct Carried {
  size_t width;
  std::vector<double> values;
};

Status carry(const Surface& surface, Carried& carried) {
  tpa_vertex_map_view map{};
  map.struct_size = sizeof map;
  if (tpa_vertex_map(surface.context(), &map) != TPA_OK) return failure("the library gives no vertex map");
  const std::vector<double> old = std::move(carried.values);
  const size_t width = carried.width;
  carried.values.resize(width * map.new_count);
  for (size_t v = 0; v < map.new_count; ++v) {
    const tpa_vertex_origin& o = map.origins[v];
    const double weight = static_cast<double>(o.weight);
    for (size_t i = 0; i < width; ++i) {
      const double first = old[width * o.parents[0] + i];
      carried.values[width * v + i] =
          o.parents[1] == TPA_NONE ? first : weight * first + (1 - weight) * old[width * o.parents[1] + i];
    }
  }
  return success();
}

struct Player {
  const Scene& scene;
  const EvolutionOptions& options;
  Surface& surface;
  Evolution& e;
  Carried carried;  // targets of the scene, then the way left of the present step
  size_t way;       // offset of these ways in `carried`
  uint32_t stall = 0;
};

double mean_edge_length(const tpa_mesh_view& m) {
  double sum = 0;
  for (size_t f = 0; f < m.triangle_count; ++f)
    for (size_t i = 0; i < 3; ++i) {
      const double *a = m.positions + 3 * size_t{m.triangles[3 * f + i]},
                   *b = m.positions + 3 * size_t{m.triangles[3 * f + (i + 1) % 3]};
      sum += length({b[0] - a[0], b[1] - a[1], b[2] - a[2]});
    }
  return sum / (3.0 * m.triangle_count);
}

// The scene's own numbers alone.
std::vector<double> carried_by_scene(const Player& p) {
  const size_t own = p.scene.carried_width, width = p.carried.width;
  std::vector<double> values;
  for (size_t i = 0; i < p.carried.values.size(); i += width)
    for (size_t k = 0; k < own; ++k) values.push_back(p.carried.values[i + k]);
  return values;
}

// Ways to the scene's targets after `step`; returns the longest.
double ask_scene(Player& p, double step) {
  const tpa_mesh_view m = p.surface.view();
  const std::vector<double> own = carried_by_scene(p);
  const Moment moment{
      p.e.time, step, {m.positions, 3 * size_t{m.vertex_count}}, {m.triangles, 3 * size_t{m.triangle_count}}, own};
  std::vector<double> targets(m.positions, m.positions + 3 * size_t{m.vertex_count});
  p.scene.motion(moment, targets);
  double longest = 0;
  for (size_t v = 0; v < m.vertex_count; ++v) {
    double* way = &p.carried.values[p.carried.width * v + p.way];
    for (size_t i = 0; i < 3; ++i) way[i] = targets[3 * v + i] - m.positions[3 * v + i];
    longest = std::max(longest, length({way[0], way[1], way[2]}));
  }
  return longest;
}

// The time step for a longest way of the given length, found by search, since ways need not be proportional to time.
double step_for_stride(Player& p, double most) {
  if (p.options.stride == 0) {
    ask_scene(p, std::min(p.scene.step, most));
    return std::min(p.scene.step, most);
  }
  const double wanted = p.options.stride * mean_edge_length(p.surface.view());
  double step = std::min(p.scene.step, most);
  for (int round = 0; round < 8; ++round) {
    const double longest = ask_scene(p, step);
    if (longest == 0) return step;
    const double next = std::min(most, step * wanted / longest);
    if (std::fabs(next - step) <= 0.01 * step) return step;
    step = next;
  }
  ask_scene(p, step);
  return step;
}

// Twice the longest way beside the mean of all, in edge lengths.
double approach(const Player& p) {
  const tpa_mesh_view m = p.surface.view();
  const auto way = [&](size_t v) {
    const double* w = &p.carried.values[p.carried.width * v + p.way];
    return Point{w[0], w[1], w[2]};
  };
  Point mean{};
  for (size_t v = 0; v < m.vertex_count; ++v) mean = mean + 1.0 / m.vertex_count * way(v);
  double longest = 0;
  for (size_t v = 0; v < m.vertex_count; ++v) longest = std::max(longest, length(way(v) - mean));
  return 2 * longest / mean_edge_length(m);
}

// One step of the surface along `part` of the remaining ways.
Status move_on(Player& p, double part, bool& rolled_back) {
  const double start = now();
  const tpa_mesh_view m = p.surface.view();
  std::vector<double> targets(m.positions, m.positions + 3 * size_t{m.vertex_count});
  for (size_t v = 0; v < m.vertex_count; ++v)
    for (size_t i = 0; i < 3; ++i) {
      double &way = p.carried.values[p.carried.width * v + p.way + i], &target = targets[3 * v + i];
      target += part * way;
      way *= 1 - part;
      // The library refuses smaller coordinates other than zero.
      if (std::fabs(target) < 0x1p-100) target = 0;
    }
  tpa_move_input move{};
  move.struct_size = sizeof move;
  move.count = m.vertex_count;
  move.position_type = TPA_FLOAT64;
  move.positions = targets.data();
  tpa_report report{};
  report.struct_size = sizeof report;
  Status s = p.surface.run([&](tpa_context* c, tpa_issue* issue) {
    const tpa_status moved = tpa_move(c, &move, issue);
    return moved != TPA_OK ? moved : tpa_step(c, nullptr, &report, issue);
  });
  (report.contacts == 0 ? p.e.seconds.detect : p.e.seconds.adapt) += now() - start;
  if (!s) return s;
  rolled_back = rolled_back || report.rolled_back_vertices > 0;
  p.e.events.add(p.surface.context(), report);
  ++p.e.substeps;
  return carry(p.surface, p.carried);
}

Status remesh(Player& p) {
  if (p.scene.edge_length == 0 || p.surface.view().vertex_count == 0) return success();
  const double start = now();
  tpa_remesh_options options{};
  options.struct_size = sizeof options;
  options.iterations = 2;
  options.target_length = p.scene.edge_length;
  options.split_ratio = p.scene.split_ratio;
  options.collapse_ratio = p.scene.collapse_ratio;
  options.relaxation = 0.5;
  const Status s =
      p.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_remesh(c, &options, nullptr, nullptr, issue); });
  p.e.seconds.remesh += now() - start;
  return s ? carry(p.surface, p.carried) : s;
}

// A mesh with so many vertices takes more than the few megabytes of a core's own cache, and remeshing has scattered it.
constexpr uint32_t most_in_cache = 1 << 14;

Status reorder(Player& p) {
  if (p.surface.view().vertex_count <= most_in_cache) return success();
  const double start = now();
  const Status s = p.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_reorder(c, issue); });
  p.e.seconds.remesh += now() - start;
  return s ? carry(p.surface, p.carried) : s;
}

Status play_step(Player& p) {
  const double start = now();
  const double step = step_for_stride(p, p.scene.duration - p.e.time);
  const double near = approach(p);
  p.e.seconds.evolve += now() - start;
  const uint32_t parts =
      near > 1 && p.options.substeps && !p.scene.whole_steps ? static_cast<uint32_t>(std::ceil(near)) : 1;
  if (near > 1 && parts == 1) ++p.e.long_steps;
  bool rolled_back = false;
  for (uint32_t k = 0; k < parts && p.surface.view().vertex_count > 0; ++k)
    if (Status s = move_on(p, 1.0 / (parts - k), rolled_back); !s) return s;
  if (rolled_back) ++p.e.steps_with_rollback;
  p.stall = rolled_back ? p.stall + 1 : 0;
  p.e.longest_stall = std::max(p.e.longest_stall, p.stall);
  p.e.time += step;
  ++p.e.steps;
  const Status s = remesh(p);
  return s ? reorder(p) : s;
}

Status start(Player& p) {
  tpa_config config;
  tpa_config_init(&config, sizeof config);
  const size_t n = p.scene.mesh.positions.size() / 3;
  config.max_vertices = static_cast<uint32_t>(n + n / 2 + 1024);
  p.surface.bound(p.options.bounds);
  p.carried.width = p.scene.carried_width + 3;
  p.way = p.scene.carried_width;
  p.carried.values.assign(n * p.carried.width, 0);
  for (size_t v = 0; v < n; ++v)
    for (size_t i = 0; i < p.way; ++i) p.carried.values[p.carried.width * v + i] = p.scene.carried[p.way * v + i];
  return p.surface.start(config, p.scene.mesh);
}

}  // namespace

Status evolve(const Scene& scene, const EvolutionOptions& options, const EvolutionObserver& observer, Surface& surface,
              Evolution& evolution) {
  const double begin = now();
  Player p{scene, options, surface, evolution, {}, 0};
  if (Status s = start(p); !s) return s;
  // A remainder from rounding is no step.
  while (evolution.time < scene.duration * (1 - 1e-9) && surface.view().vertex_count > 0) {
    if (Status s = play_step(p); !s) return s;
    evolution.seconds.total = now() - begin;
    if (!observer(surface, evolution)) break;
  }
  return success();
}

bool end_is_known(const Scene& scene, const EvolutionOptions& options, const Evolution& evolution) {
  const bool passed_through = evolution.long_steps > 0 && !scene.whole_steps;
  return !passed_through && (options.stride == 0 || scene.any_step);
}

}  // namespace tool
