// SPDX-License-Identifier: MIT
#include "tool/segment/balloon.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "tool/scenes/points.h"
#include "tool/scenes/sphere.h"

namespace tool {

namespace {

// Each time the image turns a vertex back, the speed of the vertex is halved; below this part of the full speed the
// vertex is anchored.
constexpr double least_gain = 1.0 / 16;
// Near the border, a refined mesh starts with this part of the speed.
constexpr float settling_gain = 0.25f;
// A vertex is also anchored after this many moves in a row by less than this part of a voxel.
constexpr double rest_distance = 0.03;
constexpr int rest_iterations = 4;
// The balloon is at rest after so many iterations in a row with so few moving vertices. The wait is longer for a
// handful of vertices that swing to and fro than for single vertices.
constexpr size_t lively_part[2] = {500, 150};
constexpr uint32_t quiet_iterations[2] = {15, 40};
// Iterations between two remeshings; the surface stretches by some per cent meanwhile.
constexpr uint32_t remesh_interval = 4;
// Handles and caps consist of long triangles: a few sweeps even the triangles out before the surface moves on.
constexpr uint32_t sweeps_after_handle = 5;
constexpr uint32_t sweeps_after_cap = 2;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

// The balloon's state of a vertex, carried along when the mesh changes.
struct Particle {
  float gain = 1;   // of the speed; halved at each turn, 0: anchored
  float last = 0;   // last drive, to notice a turn
  int resting = 0;  // iterations at rest in a row
};

// The surroundings of a vertex.
struct Star {
  Point normal{};  // area weighted
  Point sum{};     // of the neighbours
  uint32_t degree = 0;
  double shortest = 1e300;  // squared edge
};

struct Balloon {
  const Volume& volume;
  const BalloonOptions& o;
  Surface& surface;
  BalloonResult& result;
  double width;           // w
  double edge_length;     // aimed at now
  TriangleMesh mesh;      // as last committed
  std::vector<double> x;  // present places of its vertices
  std::vector<Particle> particles;
  std::vector<Star> stars;  // of vertices not yet anchored
  uint32_t patience = 0;    // iterations left before the contact met is resolved
  uint32_t remeshing = 0;   // sweeps due after the last step's events
  uint32_t hurry = 0;       // iterations without a chance for contacts to ripen
  bool ripe = false;        // the next step resolves the contact
};

Point point_at(const double* p) { return {p[0], p[1], p[2]}; }

void measure_stars(Balloon& b) {
  b.stars.assign(b.x.size() / 3, {});
  const auto anchored = [&](uint32_t v) { return b.particles[v].gain == 0; };
  for (size_t h = 0; h < b.mesh.triangles.size(); h += 3) {
    const uint32_t* c = &b.mesh.triangles[h];
    if (anchored(c[0]) && anchored(c[1]) && anchored(c[2])) continue;
    const Point p[3] = {point_at(&b.x[3 * size_t{c[0]}]), point_at(&b.x[3 * size_t{c[1]}]),
                        point_at(&b.x[3 * size_t{c[2]}])};
    const Point normal = cross(p[1] - p[0], p[2] - p[0]);
    for (size_t i = 0; i < 3; ++i) {
      const size_t next = i == 2 ? 0 : i + 1;
      Star &here = b.stars[c[i]], &there = b.stars[c[next]];
      here.normal = here.normal + normal;
      // Each neighbour of a vertex follows it in exactly one of its triangles.
      here.sum = here.sum + p[next];
      ++here.degree;
      const Point edge = p[next] - p[i];
      here.shortest = std::min(here.shortest, dot(edge, edge));
      there.shortest = std::min(there.shortest, dot(edge, edge));
    }
  }
}

// Speed along the normal allowed by the image: 1 well inside, 0 on the border, -1 well outside. The object ends with
// the volume, at the outer faces of its voxels.
double drive(const Balloon& b, const double* p) {
  const int size[3] = {b.volume.nx, b.volume.ny, b.volume.nz};
  for (int k = 0; k < 3; ++k)
    if (p[k] < -0.5 || p[k] > size[k] - 0.5) return -1;
  const double below = b.o.threshold - b.volume.sample(p[0], p[1], p[2]);
  return std::clamp((b.o.bright ? -below : below) / b.width, -1.0, 1.0);
}

// x' = f - g of Chen & Medioni, into `next`. Returns false where the vertex is at rest.
bool move_vertex(Balloon& b, uint32_t id, double* next) {
  Particle& particle = b.particles[id];
  if (particle.gain == 0) return false;
  const double* p = &b.x[3 * size_t{id}];
  const double s = drive(b, p);
  if (s * static_cast<double>(particle.last) < 0) {
    particle.gain *= 0.5f;
    if (static_cast<double>(particle.gain) < least_gain) {
      particle.gain = 0;
      return false;
    }
  }
  particle.last = static_cast<float>(s);
  const Star& star = b.stars[id];
  const double size_of_normal = length(star.normal);
  const double push = size_of_normal > 0 ? b.o.speed * b.edge_length * s / size_of_normal : 0;
  const double gain = static_cast<double>(particle.gain);
  double move[3], size = 0;
  for (size_t k = 0; k < 3; ++k) {
    const double pull = star.sum[k] / star.degree - p[k];
    move[k] = gain * (push * star.normal[k] + b.o.tension * pull);
    size += move[k] * move[k];
  }
  particle.resting = size < rest_distance * rest_distance ? particle.resting + 1 : 0;
  if (particle.resting >= rest_iterations) {
    particle.gain = 0;
    return false;
  }
  const double most = 0.5 * std::sqrt(star.shortest);
  const double scale = size > most * most ? most / std::sqrt(size) : 1;
  for (int k = 0; k < 3; ++k) next[k] = p[k] + scale * move[k];
  return true;
}

// Each vertex of the library's mesh gets the particle returned by pick(vertex, first parent, second parent or
// TPA_NONE).
template <class Pick>
void carry_particles(Balloon& b, Pick pick) {
  tpa_vertex_map_view map{};
  map.struct_size = sizeof map;
  if (tpa_vertex_map(b.surface.context(), &map) != TPA_OK) return;
  std::vector<Particle> next(map.new_count);
  for (uint32_t v = 0; v < map.new_count; ++v) next[v] = pick(v, map.origins[v].parents[0], map.origins[v].parents[1]);
  b.particles.swap(next);
}

// New vertices take after their livelier parent, so that a surface at rest stays at rest.
void carry_through_remeshing(Balloon& b) {
  carry_particles(b, [&](uint32_t, uint32_t parent, uint32_t other) {
    const bool second = other != TPA_NONE && b.particles[other].gain > b.particles[parent].gain;
    return b.particles[second ? other : parent];
  });
}

// New vertices start afresh, and so do vertices placed elsewhere than at their targets: new surface has yet to find the
// border. Vertices left behind go on.
void carry_through_events(Balloon& b) {
  const tpa_mesh_view view = b.surface.view();
  carry_particles(b, [&](uint32_t v, uint32_t parent, uint32_t other) {
    const double* at = view.positions + 3 * size_t{v};
    const bool arrived = std::equal(at, at + 3, b.x.data() + 3 * size_t{parent});
    const bool stayed = std::equal(at, at + 3, b.mesh.positions.data() + 3 * size_t{parent});
    return other == TPA_NONE && (arrived || stayed) ? b.particles[parent] : Particle{};
  });
}

// The library's mesh as the state to go on from.
void adopt(Balloon& b) {
  b.mesh = b.surface.copy();
  b.x = b.mesh.positions;
}

Status remesh(Balloon& b, uint32_t sweeps) {
  const double start = now();
  tpa_remesh_options options{};
  options.struct_size = sizeof options;
  options.iterations = sweeps;
  options.target_length = b.edge_length;
  options.relaxation = 0.5;
  Status s =
      b.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_remesh(c, &options, nullptr, nullptr, issue); });
  if (s) {
    carry_through_remeshing(b);
    adopt(b);
  }
  b.result.seconds.remesh += now() - start;
  return s;
}

Status step_to(Balloon& b, tpa_report& report) {
  std::vector<uint32_t> ids;
  std::vector<Point> targets;
  for (uint32_t v = 0; 3 * size_t{v} < b.x.size(); ++v) {
    const Point to = point_at(&b.x[3 * size_t{v}]);
    if (to == point_at(&b.mesh.positions[3 * size_t{v}])) continue;
    ids.push_back(v);
    targets.push_back(to);
  }
  tpa_move_input move{};
  move.struct_size = sizeof move;
  move.count = static_cast<uint32_t>(ids.size());
  move.position_type = TPA_FLOAT64;
  move.positions = targets.data();
  move.vertices = ids.data();
  report.struct_size = sizeof report;
  return b.surface.run([&](tpa_context* c, tpa_issue* issue) {
    const tpa_status moved = tpa_move(c, &move, issue);
    return moved != TPA_OK ? moved : tpa_step(c, nullptr, &report, issue);
  });
}

// Commits the moves, unless they lead into a contact that is to ripen first. Then the last mesh is taken up again, and
// the balloon goes on through itself for a while. `committed` tells the two cases apart.
Status step(Balloon& b, bool& committed) {
  const double start = now();
  committed = b.patience == 0 || --b.patience == 0;
  if (!committed) return success();
  const bool first = !b.ripe;
  b.ripe = false;
  if (b.hurry > 0) --b.hurry;
  tpa_report report{};
  Status s = step_to(b, report);
  const uint32_t handles = report.handles[0] + report.handles[1] + report.handles[2] + report.handles[3];
  if (s && first && handles > 0 && b.hurry == 0 && b.o.patience > 0) {
    s = b.surface.reload(b.mesh);
    b.patience = b.o.patience;
    b.ripe = true;
    committed = false;
  } else if (s) {
    carry_through_events(b);
    b.result.events.add(b.surface.context(), report);
    adopt(b);
    b.remeshing = handles > 0 ? sweeps_after_handle : report.groups > 0 ? sweeps_after_cap : 0;
    // A ripe contact beyond resolution as a whole is resolved piece by piece.
    if (!first && report.rolled_back_vertices > 0) b.hurry = 2 * b.o.patience;
  }
  // A step without a contact only moves and detects.
  (report.contacts == 0 ? b.result.seconds.detect : b.result.seconds.adapt) += now() - start;
  return s;
}

// From the coarse mesh at rest to the fine mesh, which settles from there.
Status refine(Balloon& b) {
  b.edge_length = b.o.edge_length;
  const Status s = remesh(b, sweeps_after_handle);
  b.particles.assign(b.x.size() / 3, {settling_gain, 0, 0});
  return s;
}

Status check_seed(const Balloon& b) {
  const double* c = b.o.center;
  const int size[3] = {b.volume.nx, b.volume.ny, b.volume.nz};
  for (int k = 0; k < 3; ++k)
    if (!(c[k] >= 0 && c[k] <= size[k] - 1))
      return failure("seed ", c[0], ",", c[1], ",", c[2], " lies outside the volume of ", size[0], " x ", size[1],
                     " x ", size[2], " voxels");
  if (drive(b, c) <= 0)
    return failure("seed lies outside the object: the volume is ", b.volume.sample(c[0], c[1], c[2]),
                   " at the seed, not ", b.o.bright ? "above" : "below", " the threshold ", b.o.threshold);
  return success();
}

}  // namespace

Status inflate(const Volume& volume, const BalloonOptions& options, const BalloonProgress& progress, Surface& surface,
               BalloonResult& result) {
  Balloon b{volume, options, surface, result, options.width, options.edge_length * options.coarseness, {}, {}, {}, {}};
  if (b.width == 0) {
    const double* c = options.center;
    b.width = std::max(1e-9, 0.5 * std::fabs(volume.sample(c[0], c[1], c[2]) - options.threshold));
  }
  if (Status s = check_seed(b); !s) return s;
  const double start = now();
  tpa_config config;
  tpa_config_init(&config, sizeof config);
  config.max_vertices = 16384;
  const int parts = std::max(2, static_cast<int>(std::lround(1.5708 * options.radius / b.edge_length)));
  if (Status s = surface.start(config, make_sphere(options.center, options.radius, parts)); !s) return s;
  adopt(b);
  b.particles.assign(b.x.size() / 3, {});
  uint32_t quiet[2] = {0, 0};
  while (result.iterations < options.most_iterations) {
    const double begin = now();
    measure_stars(b);
    const size_t n = b.x.size() / 3;
    size_t moved = 0;
    std::vector<double> next = b.x;
    for (uint32_t v = 0; v < n; ++v) moved += move_vertex(b, v, &next[3 * size_t{v}]) ? 1u : 0u;
    b.x.swap(next);
    result.seconds.evolve += now() - begin;
    bool still = moved == 0;
    for (int i = 0; i < 2; ++i) {
      quiet[i] = moved * lively_part[i] < n ? quiet[i] + 1 : 0;
      still = still || quiet[i] > quiet_iterations[i];
    }
    result.at_rest = still && b.patience == 0;
    if (result.at_rest) {
      if (b.edge_length <= options.edge_length) break;
      if (Status s = refine(b); !s) return s;
      quiet[0] = quiet[1] = 0;
      continue;
    }
    bool committed = false;
    if (Status s = step(b, committed); !s) return s;
    ++result.iterations;
    const uint32_t sweeps = std::max(b.remeshing, result.iterations % remesh_interval == 0 ? 1u : 0u);
    if (committed && sweeps > 0)
      if (Status s = remesh(b, sweeps); !s) return s;
    if (progress)
      progress(result.iterations, static_cast<uint32_t>(n), 1 - static_cast<double>(moved) / static_cast<double>(n));
  }
  result.seconds.total = now() - start;
  return success();
}

}  // namespace tool
