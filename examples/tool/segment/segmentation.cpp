// SPDX-License-Identifier: MIT
#include "tool/segment/segmentation.h"

#include <algorithm>

#include "tool/commands.h"

namespace tool {

Status prepare_phantom(const std::string& name, uint64_t noise_seed, Segmentation& s) {
  s.phantom.emplace();
  if (Status made = make_phantom(name, noise_seed, *s.phantom); !made) return made;
  s.volume = std::move(s.phantom->volume);
  std::copy(s.phantom->seed, s.phantom->seed + 3, s.options.center);
  s.options.radius = s.phantom->radius;
  s.options.threshold = s.phantom->threshold;
  // The mean edge of the paper's mesh: table 1, area of the surface over vertices. Its one thin part, the rod of
  // radius 4, stands edges half as long again, but not twice as long.
  if (s.phantom->shape == PhantomShape::cyst) {
    s.options.edge_length = 2.4;
    s.options.coarseness = 1.6;
  }
  // Its four arms meet corner by corner within a few iterations, and are to be joined at once.
  if (s.phantom->shape == PhantomShape::genus_3) s.options.patience = 7;
  return success();
}

namespace {

Status measure(Segmentation& s) {
  s.mesh = s.surface.copy();
  s.parts = parts_of(s.mesh);
  tpa_validation validation{};
  validation.struct_size = sizeof validation;
  Status valid =
      s.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_validate(c, nullptr, &validation, issue); });
  if (!valid) return valid;
  s.self_intersections = validation.self_intersections;
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

Status run_segmentation(Segmentation& s, const BalloonProgress& progress) {
  if (Status done = inflate(s.volume, s.options, progress, s.surface, s.result); !done) return done;
  return measure(s);
}

void describe(JsonWriter& json, const Segmentation& s) {
  describe_mesh(json, s.mesh);
  const BalloonSeconds& t = s.result.seconds;
  json.member("self_intersections", s.self_intersections).member("iterations", s.result.iterations);
  json.member("at_rest", s.result.at_rest);
  describe(json, s.result.events);
  json.key("seconds").begin_object().member("total", t.total).member("detect", t.detect).member("adapt", t.adapt);
  json.member("remesh", t.remesh).member("evolve", t.evolve).end_object();
  if (s.phantom)
    json.key("distance").begin_object().member("mean", s.mean_distance).member("max", s.largest_distance).end_object();
  json.member("arena_bytes", s.surface.arena_bytes()).member("peak_bytes", s.surface.peak_bytes());
}

}  // namespace tool
