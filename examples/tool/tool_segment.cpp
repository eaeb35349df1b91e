// SPDX-License-Identifier: MIT
// topoadapt segment
#include <cstdio>

#include "tool/commands.h"
#include "tool/io/volume_io.h"
#include "tool/segment/segmentation.h"

namespace tool {

namespace {

struct SegmentCall {
  Arguments arguments;
  Outputs outputs;
  SurfaceBounds bounds;
  std::string phantom;
  uint64_t noise_seed = default_noise_seed;
  double sigma = 0;
};

// Options given, in place of those in `o`.
Status read_balloon(const Arguments& a, BalloonOptions& o) {
  for (Status status : {read_point(a, "--seed", o.center), read_real(a, "--radius", o.radius),
                        read_real(a, "--threshold", o.threshold), read_real(a, "--edge", o.edge_length)})
    if (!status) return status;
  o.bright = a.has("--bright");
  if (!(o.radius > 0)) return failure("--radius must be positive");
  if (!(o.edge_length > 0)) return failure("--edge must be positive");
  return success();
}

// Everything that can be wrong before a voxel is read.
Status read_call(int count, const char* const* words, SegmentCall& call) {
  Arguments& a = call.arguments;
  if (Status status = parse_arguments(count, words,
                                      {{"--phantom", true},
                                       {"--noise-seed", true},
                                       {"--seed", true},
                                       {"--radius", true},
                                       {"--threshold", true},
                                       {"--sigma", true},
                                       {"--bright"},
                                       {"--edge", true},
                                       {"--out", true},
                                       {"--json", true},
                                       {"--max-vertices", true},
                                       {"--max-bytes", true},
                                       {"--quiet"}},
                                      a);
      !status)
    return status;
  BalloonOptions balloon;
  for (Status status : {read_text(a, "--phantom", call.phantom), read_unsigned(a, "--noise-seed", call.noise_seed),
                        read_real(a, "--sigma", call.sigma), read_balloon(a, balloon), read_bounds(a, call.bounds)})
    if (!status) return status;
  if (!(call.sigma >= 0 && call.sigma <= largest_sigma))
    return failure("--sigma must be from 0 to ", largest_sigma, " voxels");
  const bool is_phantom = !call.phantom.empty();
  const size_t volumes = is_phantom ? 0 : 1;
  if (Status status = expect_positionals(a, volumes, volumes,
                                         is_phantom ? "no VOLUME beside --phantom" : "one VOLUME, or --phantom NAME");
      !status)
    return status;
  if (!is_phantom && a.has("--noise-seed")) return failure("--noise-seed goes with --phantom");
  if (!is_phantom && !(a.has("--seed") && a.has("--threshold")))
    return failure("a VOLUME needs --seed x,y,z and --threshold T");
  return read_outputs(a, call.outputs);
}

Status prepare(const SegmentCall& call, Segmentation& s) {
  Status made = call.phantom.empty() ? read_volume(call.arguments.positionals[0], s.volume)
                                     : prepare_phantom(call.phantom, call.noise_seed, s);
  if (!made) return made;
  if (Status status = read_balloon(call.arguments, s.options); !status) return status;
  s.surface.bound(call.bounds);
  return smooth_gaussian(s.volume, call.sigma);
}

void describe_options(JsonWriter& json, const SegmentCall& call, const BalloonOptions& o) {
  json.key("options").begin_object();
  if (call.phantom.empty())
    json.member("volume", call.arguments.positionals[0]);
  else
    json.member("phantom", call.phantom).member("noise_seed", call.noise_seed);
  json.key("seed").begin_array().value(o.center[0]).value(o.center[1]).value(o.center[2]).end_array();
  json.member("radius", o.radius).member("threshold", o.threshold).member("bright", o.bright);
  json.member("sigma", call.sigma).member("edge", o.edge_length);
  describe(json, call.bounds);
  describe(json, call.outputs);
  json.end_object();
}

}  // namespace

int run_segment(int count, const char* const* words) {
  SegmentCall call;
  Segmentation s;
  if (Status status = read_call(count, words, call); !status) return refuse(status);
  if (Status status = prepare(call, s); !status) return refuse(status);
  {
    Progress progress(call.outputs.quiet);
    const Status status = run_segmentation(s, [&](uint32_t iteration, uint32_t vertices, double resting) {
      char line[120];
      std::snprintf(line, sizeof line, "iteration %u, %u vertices, %.0f %% at rest", iteration, vertices,
                    100 * resting);
      progress.show(line);
    });
    if (!status) return refuse(status);
  }
  JsonWriter json;
  json.begin_object();
  describe(json, s);
  describe_options(json, call, s.options);
  json.end_object();
  if (!call.outputs.mesh.empty())
    if (Status status = write_mesh(call.outputs.mesh, s.mesh); !status) return refuse(status);
  if (Status status = write_json(call.outputs.json, json); !status) return refuse(status);
  if (call.outputs.summary_wanted()) {
    long genus = 0;
    for (const Part& p : s.parts) genus += p.genus;
    std::printf("%u iterations, %.2f s, %zu vertices, %zu components, genus %ld, %llu self-intersections\n",
                s.result.iterations, s.result.seconds.total, s.mesh.positions.size() / 3, s.parts.size(), genus,
                static_cast<unsigned long long>(s.self_intersections));
  }
  return s.self_intersections == 0 ? 0 : 1;
}

}  // namespace tool
