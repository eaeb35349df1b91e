// SPDX-License-Identifier: MIT
// topoadapt segment
#include <cstdio>

#include "tool/commands.h"
#include "tool/io/volume_io.h"
#include "tool/segment/segmentation.h"

namespace tool {

namespace {

Status read_options(const Arguments& a, Segmentation& s, std::string& out, std::string& json) {
  BalloonOptions& o = s.options;
  for (Status status :
       {read_point(a, "--seed", o.center), read_real(a, "--radius", o.radius), read_real(a, "--threshold", o.threshold),
        read_real(a, "--edge", o.edge_length), read_text(a, "--out", out), read_text(a, "--json", json)})
    if (!status) return status;
  o.bright = a.has("--bright");
  SurfaceBounds bounds;
  if (Status status = read_bounds(a, bounds); !status) return status;
  s.surface.bound(bounds);
  if (!(o.radius > 0)) return failure("--radius must be positive");
  if (!(o.edge_length > 0)) return failure("--edge must be positive");
  return success();
}

Status read_source(const Arguments& a, Segmentation& s) {
  std::string name;
  uint64_t noise_seed = default_noise_seed;
  if (Status status = read_text(a, "--phantom", name); !status) return status;
  if (Status status = read_unsigned(a, "--noise-seed", noise_seed); !status) return status;
  if (!name.empty()) {
    if (Status status = expect_positionals(a, 0, 0, "no VOLUME beside --phantom"); !status) return status;
    return prepare_phantom(name, noise_seed, s);
  }
  if (Status status = expect_positionals(a, 1, 1, "one VOLUME, or --phantom NAME"); !status) return status;
  if (a.has("--noise-seed")) return failure("--noise-seed goes with --phantom");
  if (!a.has("--seed") || !a.has("--threshold")) return failure("a VOLUME needs --seed x,y,z and --threshold T");
  return read_volume(a.positionals[0], s.volume);
}

Status smooth_volume(const Arguments& a, Segmentation& s) {
  double sigma = 0;
  if (Status status = read_real(a, "--sigma", sigma); !status) return status;
  return sigma == 0 ? success() : smooth_gaussian(s.volume, sigma);
}

}  // namespace

int run_segment(int count, const char* const* words) {
  Arguments a;
  Segmentation s;
  std::string out, json_path;
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
    return refuse(status);
  if (Status status = read_source(a, s); !status) return refuse(status);
  if (Status status = read_options(a, s, out, json_path); !status) return refuse(status);
  if (Status status = smooth_volume(a, s); !status) return refuse(status);
  {
    Progress progress(a.has("--quiet"));
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
  json.end_object();
  if (!out.empty())
    if (Status status = write_mesh(out, s.mesh); !status) return refuse(status);
  if (Status status = write_json(json_path, json); !status) return refuse(status);
  if (json_path != "-") {
    long genus = 0;
    for (const Part& p : s.parts) genus += p.genus;
    std::printf("%u iterations, %.2f s, %zu vertices, %zu components, genus %ld, %llu self-intersections\n",
                s.result.iterations, s.result.seconds.total, s.mesh.positions.size() / 3, s.parts.size(), genus,
                static_cast<unsigned long long>(s.self_intersections));
  }
  return s.self_intersections == 0 ? 0 : 1;
}

}  // namespace tool
