// SPDX-License-Identifier: MIT
#include "tool/segment/segmentation.h"

#include <algorithm>
#include <utility>

#include "tool/commands.h"
#include "tool/segment/passes.h"

namespace tool {

int64_t genus_of(const std::vector<Part>& parts) {
  int64_t genus = 0;
  for (const Part& p : parts) genus += p.genus;
  return genus;
}

Status prepare_phantom(const std::string& name, uint64_t noise_seed, Segmentation& s) {
  s.phantom.emplace();
  if (Status made = make_phantom(name, noise_seed, *s.phantom); !made) return made;
  s.volume = std::move(s.phantom->volume);
  s.options.seeds = {{s.phantom->seed[0], s.phantom->seed[1], s.phantom->seed[2]}};
  s.options.radius = s.phantom->radius;
  s.options.threshold = {s.phantom->threshold, false};
  // The mean edge of the paper's mesh: table 1, area of the surface over vertices. Its one thin part, the rod of
  // radius 4, stands edges half as long again, but not twice as long.
  if (s.phantom->shape == PhantomShape::cyst) {
    s.options.edge_length = 2.4;
    s.options.coarseness = 1.6;
  }
  // The paper's meshes have edges of one length, which grow shorter only where noise on a face leaves out too much.
  s.options.edge_thin = s.options.edge_length;
  s.options.edge_fine = 1;
  // Its four arms meet corner by corner within a few iterations, and are to be joined at once.
  if (s.phantom->shape == PhantomShape::genus_3) s.options.patience = 7;
  return success();
}

namespace {

// The neighbour's share of the first balls from which on a result would be the neighbour's as well.
constexpr double most_foreign = 0.1;

std::string text_of_place(const Volume& volume, const Index& v) {
  const Point at = volume.in_file(volume.to_world({double(v.i), double(v.j), double(v.k)}));
  return text_of("voxel ", v.i, ",", v.j, ",", v.k, " (", at[0], ",", at[1], ",", at[2], " mm)");
}

Status check_balls(const Segmentation& s) {
  if (static_cast<double>(s.balls.foreign) <= most_foreign * static_cast<double>(s.balls.object)) return success();
  return failure("--radius ", s.options.radius, " mm: the first ball reaches another part beyond the object, at ",
                 text_of_place(s.volume, s.balls.neighbour));
}

Status measure(Segmentation& s, double drop_below) {
  tpa_validation validation{};
  validation.struct_size = sizeof validation;
  Status valid =
      s.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_validate(c, nullptr, &validation, issue); });
  if (!valid) return valid;
  s.self_intersections = validation.self_intersections;
  s.mesh = s.surface.copy();
  s.dropped = drop_small_parts(s.mesh, drop_below);
  s.parts = parts_of(s.mesh);
  s.filling = compare(s.volume, s.options.threshold, s.object, s.mesh, reach_of_edges(s.volume, s.options.edge_length));
  if (!s.phantom) return success();
  const size_t n = s.mesh.positions.size() / 3;
  double sum = 0;
  for (size_t v = 0; v < n; ++v) {
    const double* p = &s.mesh.positions[3 * v];
    const double d = distance_to_surface(*s.phantom, p[0], p[1], p[2]);
    sum += d;
    s.largest_distance = std::max(s.largest_distance, d);
  }
  s.mean_distance = n > 0 ? sum / static_cast<double>(n) : 0;
  return success();
}

}  // namespace

Status prepare_object(Segmentation& s) {
  BalloonOptions& o = s.options;
  if (Status room = check_memory(s.volume); !room) return room;
  const bool from_balls = o.first.triangles.empty();
  const std::vector<uint8_t> start = from_balls ? std::vector<uint8_t>() : enclosed_voxels(s.volume, o.first);
  Status found = from_balls ? find_object(s.volume, o.threshold, o.seeds, s.object)
                            : find_object(s.volume, o.threshold, start, s.object);
  if (!found) return found;
  s.border = measure_border(s.volume, s.object);
  if (o.noise < 0) o.noise = s.border.noise;
  s.noise_range = topology_within_noise(s.volume, o.threshold, s.object, o.noise);
  if (o.width == 0) o.width = force_width(s.border);
  if (o.radius == 0) o.radius = fitting_radius(s.volume, s.object, o.seeds, default_radius * mean_side(s.volume));
  if (Status good = check_budget(s.volume, s.border, o, s.bounds); !good) return good;
  if (o.edge_fine == 0) o.edge_fine = least_fine * o.edge_length;
  if (o.edge_thin == 0) o.edge_thin = thin_fine * o.edge_length;
  if (o.edge_fine * edge_steps < o.edge_length)
    return failure("--edge-fine ", o.edge_fine, " mm is less than --edge / ", edge_steps);
  o.edge_fine = std::min(o.edge_fine, o.edge_length);
  o.edge_thin = std::clamp(o.edge_thin, o.edge_fine, o.edge_length);
  s.edges = measure_edges(s.volume, s.object, o.edge_thin, o.edge_length);
  s.balls = from_balls ? fit_balls(s.volume, o.threshold, s.object, o.seeds, o.radius) : fit_start(start, s.object);
  return check_balls(s);
}

Status run_segmentation(Segmentation& s, const BalloonWatch& watch, double drop_below, const PassWatch& before_pass) {
  if (Status prepared = prepare_object(s); !prepared) return prepared;
  s.surface.bound(s.bounds);
  for (std::vector<uint8_t> missing;;) {
    Status done = inflate(s.volume, s.edges, s.options, watch, s.resumed, s.surface, s.result, &s.left);
    // A pass that never begins leaves the mesh of the pass before.
    if (!done && s.parts.size() > 0 && s.surface.at_limit()) {
      s.result.ended = Ended::limit;
      s.result.limit = done.message;
      return success();
    }
    if (done) done = measure(s, drop_below);
    if (!done) return done;
    if (!s.passes.empty()) end_pass(s, missing);
    if (s.result.ended != Ended::at_rest || !begin_pass(s, missing)) return done;
    if (before_pass) before_pass(s, s.passes.back());
    s.resumed = {std::exchange(s.left.bytes, {}), true};
  }
}

namespace {

void describe(JsonWriter& json, std::string_view key, const std::vector<Piece>& pieces) {
  json.key(key).begin_array();
  for (const Piece& p : pieces) {
    json.begin_object().member("voxels", p.voxels);
    json.key("voxel").begin_array().value(p.voxel.i).value(p.voxel.j).value(p.voxel.k).end_array();
    json.key("mm").begin_array().value(p.world[0]).value(p.world[1]).value(p.world[2]).end_array().end_object();
  }
  json.end_array();
}

void describe(JsonWriter& json, const Filling& f) {
  json.key("fill").begin_object().member("share", f.share()).member("object_voxels", f.object);
  json.member("inside_voxels", f.inside).member("near_voxels", f.near);
  json.member("rim_voxels", f.rim).member("beyond_voxels", f.beyond).member("neighbour_voxels", f.foreign);
  describe(json, "left_out", f.left_out);
  describe(json, "leaks", f.leaks);
  describe(json, "neighbours", f.neighbours);
  json.end_object();
}

void describe(JsonWriter& json, std::string_view key, const VoxelTopology& t) {
  json.key(key).begin_object().member("voxels", t.voxels).member("surfaces", t.surfaces);
  json.member("genus", t.genus).end_object();
}

void describe(JsonWriter& json, const NoiseRange& range) {
  json.key("voxel_topology").begin_object().member("shift", range.shift);
  describe(json, "object", range.object);
  describe(json, "surest", range.surest);
  describe(json, "uncertain", range.uncertain);
  json.end_object();
}

void describe(JsonWriter& json, const std::vector<Pass>& passes) {
  json.key("passes").begin_array();
  for (const Pass& p : passes) {
    json.begin_object().member("shortest_edge", p.shortest).member("missing_voxels", p.missing);
    json.member("filled_voxels", p.filled).member("iterations", p.iterations).member("vertices", p.vertices);
    json.member("seconds", p.seconds).end_object();
  }
  json.end_array();
}

}  // namespace

void describe(JsonWriter& json, const Segmentation& s) {
  describe_mesh(json, s.mesh);
  const BalloonSeconds& t = s.result.seconds;
  json.member("self_intersections", s.self_intersections).member("iterations", s.result.iterations);
  json.member("ended", name_of(s.result.ended)).member("dropped_components", s.dropped);
  describe(json, s.filling);
  describe(json, s.passes);
  json.key("first_balls").begin_object().member("voxels", s.balls.voxels).member("outside", s.balls.outside());
  json.member("neighbour_voxels", s.balls.foreign).end_object();
  json.key("border").begin_object().member("contrast", s.border.contrast).member("noise", s.border.noise);
  json.member("area", s.border.area).end_object();
  describe(json, s.noise_range);
  describe(json, s.result.events);
  json.key("seconds").begin_object().member("total", t.total).member("detect", t.detect).member("adapt", t.adapt);
  json.member("remesh", t.remesh).member("evolve", t.evolve).end_object();
  if (s.phantom)
    json.key("distance").begin_object().member("mean", s.mean_distance).member("max", s.largest_distance).end_object();
  json.member("arena_bytes", s.surface.arena_bytes()).member("peak_bytes", s.surface.peak_bytes());
}

}  // namespace tool
