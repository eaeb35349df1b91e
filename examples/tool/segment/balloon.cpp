// SPDX-License-Identifier: MIT
#include "tool/segment/balloon.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tool/scenes/sphere.h"
#include "tool/segment/balloon_remesh.h"
#include "tool/segment/doubt.h"

namespace tool {

namespace {

// The balloon is at rest after so many iterations in a row with so few moving vertices. The wait is longer for a
// handful of vertices that swing to and fro than for single vertices.
constexpr size_t lively_part[2] = {500, 150};
constexpr uint32_t quiet_iterations[2] = {15, 40};
// Vertices swing about their places, and remeshing cuts and merges the same edges again and again, where topology
// stays, and the least and the greatest volume of so many iterations are those of as many before, within a voxel, or
// one for each so many vertices.
constexpr uint32_t swing_iterations = 80;
constexpr double vertices_of_swing = 10000;
// Iterations between two remeshings; the surface stretches by some per cent meanwhile.
constexpr uint32_t remesh_interval = 4;
// Handles and caps consist of long triangles: a few sweeps even the triangles out before the surface moves on.
constexpr uint32_t sweeps_after_handle = 5;
constexpr uint32_t sweeps_after_cap = 2;
// Edges in thin parts are so many times longer while the balloon inflates: eight round a tube lead the front as well
// as sixteen do.
constexpr double stretch_of_thin = 2;
// A step is taken anew so many times while contacts are in doubt.
constexpr uint32_t most_trials = 8;

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
    return moved != TPA_OK ? moved : tpa_step(c, b.workers.exec(), &report, issue);
  });
}

// As step_to, without tunnels that noise may have made.
Status step_without_doubt(Balloon& b, tpa_report& report) {
  for (uint32_t trial = 0; trial < most_trials; ++trial) {
    if (Status s = step_to(b, report); !s || !hold_doubtful_contacts(b)) return s;
    if (Status s = b.surface.reload(b.mesh); !s) return s;
  }
  return step_to(b, report);
}

// Takes account of a step that is committed.
void follow_swing(Balloon& b, const tpa_report& report) {
  Swing& w = b.swing;
  const double volume = report.region_after;
  if (report.groups > 0) w = {};
  w.least = w.iterations == 0 ? volume : std::min(w.least, volume);
  w.most = w.iterations == 0 ? volume : std::max(w.most, volume);
  if (++w.iterations < swing_iterations) return;
  const double voxel = b.forces.voxel * b.forces.voxel * b.forces.voxel;
  const double range = voxel * std::max(1.0, static_cast<double>(b.particles.size()) / vertices_of_swing);
  const bool same = std::fabs(w.least - w.least_before) <= range && std::fabs(w.most - w.most_before) <= range;
  w = {0, 0, 0, w.least, w.most, same ? uint8_t{1} : uint8_t{0}};
}

// Commits the moves, unless they lead into a contact that is to ripen first. Then the last mesh is taken up again, and
// the balloon goes on through itself for a while. `committed` tells the two cases apart.
Status step(Balloon& b, bool& committed) {
  const double start = seconds_now();
  committed = b.patience == 0 || --b.patience == 0;
  if (!committed) return success();
  const bool first = b.ripe == 0;
  b.ripe = 0;
  if (b.hurry > 0) --b.hurry;
  tpa_report report{};
  Status s = step_without_doubt(b, report);
  const uint32_t handles = report.handles[0] + report.handles[1] + report.handles[2] + report.handles[3];
  if (s && first && handles > 0 && b.hurry == 0 && b.o.patience > 0) {
    s = b.surface.reload(b.mesh);
    b.patience = b.o.patience;
    b.ripe = 1;
    committed = false;
  } else if (s) {
    carry_through_events(b);
    b.result.events.add(b.surface.context(), report);
    adopt(b);
    follow_swing(b, report);
    b.result.volume = report.region_after;
    b.remeshing = handles > 0 ? sweeps_after_handle : report.groups > 0 ? sweeps_after_cap : 0;
    // A ripe contact beyond resolution as a whole is resolved piece by piece.
    if (!first && report.rolled_back_vertices > 0) b.hurry = 2 * b.o.patience;
  }
  // A step without a contact only moves and detects.
  (report.contacts == 0 ? b.result.seconds.detect : b.result.seconds.adapt) += seconds_now() - start;
  return s;
}

bool is_coarse(const Balloon& b) { return b.forces.edge_length > b.o.edge_length || b.stretch > 1; }

// From the coarse mesh at rest to the fine mesh, which settles from there. Thin parts may go on where long edges did
// not enter, at full speed.
Status refine(Balloon& b) {
  const bool everywhere = b.forces.edge_length > b.o.edge_length;
  b.forces.edge_length = b.o.edge_length;
  b.stretch = 1;
  const Status s = remesh_all(b, everywhere ? sweeps_after_handle : sweeps_after_cap);
  for (size_t v = 0; v < b.particles.size(); ++v)
    if (everywhere || part_at(b, point_at(&b.x[3 * v])) < 1)
      b.particles[v] = {everywhere ? settling_gain : 1, 0, 0, Due::none};
  return s;
}

// The balls round the seeds; several may overlap.
TriangleMesh make_balls(const Balloon& b) {
  const int parts = std::max(2, static_cast<int>(std::lround(1.5708 * b.o.radius / b.forces.edge_length)));
  TriangleMesh balls;
  for (const Point& seed : b.o.seeds) {
    const TriangleMesh ball = make_sphere({seed[0], seed[1], seed[2]}, b.o.radius, parts);
    const uint32_t first = static_cast<uint32_t>(balls.positions.size() / 3);
    balls.positions.insert(balls.positions.end(), ball.positions.begin(), ball.positions.end());
    for (const uint32_t v : ball.triangles) balls.triangles.push_back(first + v);
  }
  return balls;
}

// A surface given, with edges of the length aimed at.
Status start_from_first(Balloon& b) {
  if (Status s = b.surface.start(balloon_config(), b.o.first); !s) return s;
  tpa_validation found{};
  found.struct_size = sizeof found;
  const auto validate = [&](tpa_context* c, tpa_issue* issue) { return tpa_validate(c, nullptr, &found, issue); };
  if (Status s = b.surface.run(validate); !s) return s;
  if (found.self_intersections > 0)
    return failure("the first surface: ", found.self_intersections, " pairs of triangles meet (topoadapt resolve)");
  adopt(b);
  b.particles.assign(b.x.size() / 3, {});
  return remesh_all(b, sweeps_after_handle);
}

// The balls as one surface.
Status start(Balloon& b) {
  if (!b.o.first.triangles.empty()) return start_from_first(b);
  if (b.edges.least < 1) b.stretch = stretch_of_thin;
  if (Status s = b.surface.start(balloon_config(), make_balls(b)); !s) return s;
  if (b.o.seeds.size() > 1)
    if (Status s =
            b.surface.run([](tpa_context* c, tpa_issue* issue) { return tpa_adapt(c, nullptr, nullptr, issue); });
        !s)
      return s;
  adopt(b);
  b.particles.assign(b.x.size() / 3, {});
  return success();
}

// Moves all vertices. Returns how many moved.
size_t evolve(Balloon& b) {
  const double begin = seconds_now();
  measure_stars(b.mesh.triangles, b.x, b.particles, b.stars);
  std::vector<double> next = b.x;
  std::vector<uint8_t> has_moved(b.particles.size());
  for_vertices(b, [&](size_t v) {
    Particle& here = b.particles[v];
    has_moved[v] = move_vertex(b.forces, b.stars[v], &b.x[3 * v], here, &next[3 * v]) ? 1 : 0;
    if (has_moved[v] != 0) here.due = std::max(here.due, Due::moved);
  });
  const size_t moved = std::accumulate(has_moved.begin(), has_moved.end(), size_t{0});
  b.x.swap(next);
  b.result.seconds.evolve += seconds_now() - begin;
  return moved;
}

bool is_at_rest(Balloon& b, size_t moved) {
  bool still = moved == 0 || b.swing.at_rest != 0;
  for (int i = 0; i < 2; ++i) {
    b.quiet[i] = moved * lively_part[i] < b.particles.size() ? b.quiet[i] + 1 : 0;
    still = still || b.quiet[i] > quiet_iterations[i];
  }
  return still && b.patience == 0;
}

// One iteration. `resting`: nothing moves any more, and the edges are as fine as they are to be.
Status iterate(Balloon& b, const BalloonWatch& watch, bool& resting) {
  const size_t n = b.particles.size(), moved = evolve(b);
  resting = is_at_rest(b, moved);
  if (resting) {
    if (!is_coarse(b)) return success();
    resting = false;
    b.quiet[0] = b.quiet[1] = 0;
    b.swing = {};
    return refine(b);
  }
  bool committed = false;
  if (Status s = step(b, committed); !s) return s;
  ++b.result.iterations;
  if (committed && b.remeshing > 0)
    if (Status s = remesh_due(b, Due::made, b.remeshing); !s) return s;
  if (committed && b.result.iterations % remesh_interval == 0)
    if (Status s = remesh_due(b, Due::moved, 1); !s) return s;
  if (watch.progress)
    watch.progress(b.result.iterations, static_cast<uint32_t>(n),
                   1 - static_cast<double>(moved) / static_cast<double>(n), b.result.volume);
  return watch.frame ? watch.frame(b.result.iterations) : success();
}

// Lets the places with shorter edges than before move on.
Status liven(Balloon& b) {
  b.quiet[0] = b.quiet[1] = 0;
  b.swing = {};
  for (size_t v = 0; v < b.particles.size(); ++v)
    if (b.edges.is_shortened_at(point_at(&b.x[3 * v]))) b.particles[v] = {settling_gain, 0, 0, Due::none};
  return remesh_all(b, 1);
}

Forces forces_of(const Volume& volume, const BalloonOptions& o) {
  return {volume,
          inverse(volume.to_world),
          mean_side(volume),
          o.threshold,
          o.width,
          o.speed,
          o.tension,
          o.edge_length * o.coarseness,
          o.noise,
          grid_for(mean_side(volume))};
}

}  // namespace

const char* name_of(Ended ended) {
  switch (ended) {
    case Ended::at_rest: return "at rest";
    case Ended::iterations: return "iterations";
    case Ended::interrupted: return "interrupted";
    case Ended::limit: return "limit";
  }
  return "";
}

Status inflate(const Volume& volume, const EdgeField& edges, const BalloonOptions& options, const BalloonWatch& watch,
               const BalloonState& resumed, Surface& surface, BalloonResult& result, BalloonState* left) {
  const Workers workers(options.threads);
  Balloon b{options, edges, surface, result, forces_of(volume, options), workers, {}, {}, {}, {}};
  const double begun = seconds_now();
  if (Status s = resumed.bytes.empty() ? start(b) : restore(b, resumed); !s) return s;
  result.ended = Ended::iterations;
  Status last = resumed.livened ? liven(b) : success();
  while (last && result.ended == Ended::iterations && result.iterations < options.most_iterations) {
    if (watch.interrupted && watch.interrupted()) {
      result.ended = Ended::interrupted;
      break;
    }
    bool resting = false;
    last = iterate(b, watch, resting);
    if (resting) result.ended = Ended::at_rest;
  }
  if (!last) {
    if (!surface.at_limit()) return last;
    result.ended = Ended::limit;
    result.limit = last.message;
  }
  result.seconds.total += seconds_now() - begun;
  return left != nullptr && result.ended != Ended::limit ? save(b, *left) : success();
}

}  // namespace tool
