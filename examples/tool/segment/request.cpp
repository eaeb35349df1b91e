// SPDX-License-Identifier: MIT
#include "tool/segment/request.h"

#include <climits>
#include <filesystem>

#include "tool/io/output_file.h"
#include "tool/io/volume_write.h"

namespace tool {

namespace {

Status parse(int count, const char* const* words, Arguments& a) {
  return parse_arguments(count, words,
                         {{"--info"},
                          {"--phantom", true},
                          {"--noise-seed", true},
                          {"--seed", true, true},
                          {"--seed-mm", true, true},
                          {"--radius", true},
                          {"--threshold", true},
                          {"--bright"},
                          {"--lower", true},
                          {"--upper", true},
                          {"--label", true},
                          {"--all-labels"},
                          {"--start-mask", true},
                          {"--start-mesh", true},
                          {"--time", true},
                          {"--nan-as-background"},
                          {"--sigma", true},
                          {"--edge", true},
                          {"--edge-fine", true},
                          {"--width", true},
                          {"--tension", true},
                          {"--speed", true},
                          {"--iterations", true},
                          {"--threads", true},
                          {"--space", true},
                          {"--partial"},
                          {"--drop-below", true},
                          {"--genus", true},
                          {"--every", true},
                          {"--frames", true},
                          {"--save", true},
                          {"--resume", true},
                          {"--out", true},
                          {"--mask", true},
                          {"--json", true},
                          {"--html", true},
                          {"--png", true},
                          {"--max-vertices", true},
                          {"--max-bytes", true},
                          {"--quiet"}},
                         a);
}

Status read_positive(const Arguments& a, std::string_view name, std::optional<double>& value) {
  double read = 0;
  if (!a.has(name)) return success();
  if (Status s = read_real(a, name, read); !s) return s;
  if (!(read > 0)) return failure(name, " must be positive");
  value = read;
  return success();
}

Status read_optional(const Arguments& a, std::string_view name, std::optional<double>& value) {
  double read = 0;
  if (Status s = read_real(a, name, read); !s) return s;
  if (a.has(name)) value = read;
  return success();
}

// One way to tell the object: --threshold, --lower with or without --upper, or --label.
Status read_selection(const Arguments& a, SegmentRequest& r) {
  Selection& c = r.selection;
  for (Status s : {read_optional(a, "--threshold", c.threshold), read_optional(a, "--lower", c.lower),
                   read_optional(a, "--upper", c.upper), read_optional(a, "--label", c.label)})
    if (!s) return s;
  c.bright = a.has("--bright");
  r.all_labels = a.has("--all-labels");
  const int ways = (c.threshold ? 1 : 0) + (c.lower || c.upper ? 1 : 0) + (c.label ? 1 : 0) + (r.all_labels ? 1 : 0);
  if (ways > 1) return failure("one of --threshold, --lower with --upper, --label and --all-labels is enough");
  if (c.bright && ways > 0 && !c.threshold) return failure("--bright goes with --threshold");
  if (c.lower && c.upper && !(*c.lower < *c.upper)) return failure("--lower must be below --upper");
  uint64_t time = 0;
  if (Status s = read_unsigned(a, "--time", time); !s) return s;
  if (a.has("--time")) r.reading.time = time;
  r.reading.allow_nan = a.has("--nan-as-background");
  return success();
}

Status read_forces(const Arguments& a, SegmentRequest& r) {
  for (Status s : {read_positive(a, "--radius", r.radius), read_positive(a, "--edge", r.edge),
                   read_positive(a, "--edge-fine", r.edge_fine), read_positive(a, "--width", r.width),
                   read_positive(a, "--speed", r.speed)})
    if (!s) return s;
  if (Status s = read_optional(a, "--tension", r.tension); !s) return s;
  if (r.tension && !(*r.tension >= 0 && *r.tension <= 1)) return failure("--tension must be from 0 to 1");
  if (Status s = read_real(a, "--sigma", r.sigma); !s) return s;
  return r.sigma >= 0 ? success() : failure("--sigma must not be negative");
}

Status read_space(const Arguments& a, OutputSpace& space) {
  std::string name;
  if (Status s = read_text(a, "--space", name); !s) return s;
  if (name == "ras") space = OutputSpace::ras;
  if (name == "lps") space = OutputSpace::lps;
  if (name == "voxel") space = OutputSpace::voxel;
  const bool good = name.empty() || space != OutputSpace::of_file;
  return good ? success() : failure("--space: \"", name, "\" is none of ras, lps, voxel");
}

Status read_answer(const Arguments& a, SegmentRequest& r) {
  r.partial = a.has("--partial");
  for (Status s : {read_space(a, r.space), read_real(a, "--drop-below", r.drop_below),
                   read_unsigned(a, "--iterations", r.iterations), read_unsigned(a, "--threads", r.threads)})
    if (!s) return s;
  if (r.threads < 1 || r.threads > most_threads) return failure("--threads must be from 1 to ", most_threads);
  if (!(r.drop_below >= 0)) return failure("--drop-below must not be negative");
  uint64_t genus = 0;
  if (Status s = read_unsigned(a, "--genus", genus); !s) return s;
  if (genus > INT_MAX) return failure("--genus must be at most ", INT_MAX);
  if (a.has("--genus")) r.genus = static_cast<int64_t>(genus);
  return success();
}

Status read_files(const Arguments& a, SegmentRequest& r) {
  for (Status s : {read_unsigned(a, "--every", r.every), read_text(a, "--frames", r.frames),
                   read_text(a, "--mask", r.mask), read_text(a, "--save", r.save), read_text(a, "--resume", r.resume)})
    if (!s) return s;
  for (const char* of_one : {"--every", "--frames", "--save", "--resume", "--html", "--png"})
    if (r.all_labels && a.has(of_one)) return failure(of_one, " goes with one object, not with --all-labels");
  if (a.has("--every") != a.has("--frames")) return failure("--every N and --frames DIR go together");
  if (a.has("--every") && r.every == 0) return failure("--every must be at least 1");
  if (!r.mask.empty())
    if (Status s = check_labels_output(r.mask); !s) return s;
  if (!r.save.empty())
    if (Status s = check_output(r.save); !s) return s;
  if (r.frames.empty()) return success();
  if (!std::filesystem::is_directory(r.frames)) return failure(r.frames, ": is no folder (--frames)");
  return check_output((std::filesystem::path(r.frames) / "frame.ply").string());
}

Status read_input(const Arguments& a, SegmentRequest& r) {
  for (Status s : {read_text(a, "--phantom", r.phantom), read_unsigned(a, "--noise-seed", r.noise_seed),
                   read_points(a, "--seed", r.voxel_seeds), read_points(a, "--seed-mm", r.world_seeds),
                   read_text(a, "--start-mask", r.start_mask), read_text(a, "--start-mesh", r.start_mesh)})
    if (!s) return s;
  const bool is_phantom = !r.phantom.empty();
  const size_t volumes = is_phantom ? 0 : 1;
  if (Status s = expect_positionals(a, volumes, volumes,
                                    is_phantom ? "no VOLUME beside --phantom" : "one VOLUME, or --phantom NAME");
      !s)
    return s;
  if (!is_phantom) r.volume = a.positionals[0];
  if (!is_phantom && a.has("--noise-seed")) return failure("--noise-seed goes with --phantom");
  for (const char* of_volume : {"--lower", "--upper", "--label", "--all-labels", "--time", "--nan-as-background",
                                "--start-mask", "--start-mesh"})
    if (is_phantom && a.has(of_volume)) return failure(of_volume, " goes with a VOLUME");
  if (is_phantom) return success();
  if (r.info) return success();
  const int starts =
      (a.has("--seed") || a.has("--seed-mm") ? 1 : 0) + (r.start_mask.empty() ? 0 : 1) + (r.start_mesh.empty() ? 0 : 1);
  if (starts > 1) return failure("one of seeds, --start-mask and --start-mesh is enough");
  if (r.all_labels && starts > 0) return failure("--all-labels begins with the surface of each label");
  if ((starts == 0 && !starts_from_label(r)) || !(r.selection.is_given() || r.all_labels))
    return failure(
        "a VOLUME needs --seed x,y,z or --seed-mm x,y,z, and --threshold T, --lower A or --upper B; or --label K, or "
        "--all-labels");
  return success();
}

void member(JsonWriter& json, std::string_view name, const std::string& text) {
  text.empty() ? json.key(name).null() : json.member(name, text);
}

template <class Number>
void member(JsonWriter& json, std::string_view name, const std::optional<Number>& number) {
  number ? json.member(name, *number) : json.key(name).null();
}

// A band and a label have a threshold that is not one of grey values.
void describe(JsonWriter& json, const Selection& s, const Threshold& threshold) {
  const bool other = (s.lower && s.upper) || s.label;
  member(json, "threshold", other ? std::optional<double>() : threshold.value);
  json.member("bright", threshold.bright);
  member(json, "lower", s.lower);
  member(json, "upper", s.upper);
  member(json, "label", s.label);
}

}  // namespace

Status read_request(int count, const char* const* words, SegmentRequest& r) {
  Arguments a;
  if (Status s = parse(count, words, a); !s) return s;
  for (Status s : {read_forces(a, r), read_selection(a, r), read_answer(a, r), read_bounds(a, r.bounds)})
    if (!s) return s;
  r.info = a.has("--info");
  if (Status s = read_input(a, r); !s) return s;
  for (const char* of_mesh : {"--out", "--mask", "--save", "--resume", "--frames", "--html", "--all-labels", "--label",
                              "--lower", "--upper", "--start-mask", "--start-mesh"})
    if (r.info && a.has(of_mesh)) return failure(of_mesh, " goes with a segmentation, not with --info");
  if (Status s = read_files(a, r); !s) return s;
  if (Status s = read_outputs(a, r.outputs); !s) return s;
  return read_view(a, r.outputs, r.view);
}

void describe(JsonWriter& json, const SegmentRequest& r, const Segmentation& s) {
  const BalloonOptions& o = s.options;
  json.key("options").begin_object();
  if (r.phantom.empty())
    json.member("volume", r.volume);
  else
    json.member("phantom", r.phantom).member("noise_seed", r.noise_seed);
  json.key("seeds_mm").begin_array();
  for (const Point& seed : o.seeds) {
    const Point p = s.volume.in_file(seed);
    json.begin_array().value(p[0]).value(p[1]).value(p[2]).end_array();
  }
  json.end_array();
  json.member("radius", o.radius);
  describe(json, r.selection, o.threshold);
  member(json, "time", r.reading.time);
  json.member("nan_as_background", r.reading.allow_nan);
  json.member("sigma", r.sigma)
      .member("edge", o.edge_length)
      .member("edge_thin", o.edge_thin)
      .member("edge_fine", o.edge_fine)
      .member("coarseness", o.coarseness);
  json.member("width", o.width).member("tension", o.tension).member("speed", o.speed);
  json.member("iterations", o.most_iterations)
      .member("threads", r.threads)
      .member("partial", r.partial)
      .member("drop_below", r.drop_below);
  member(json, "genus", r.genus);
  json.member("every", r.every);
  member(json, "frames", r.frames);
  member(json, "start_mask", r.start_mask);
  member(json, "start_mesh", r.start_mesh);
  member(json, "mask", r.mask);
  member(json, "save", r.save);
  member(json, "resume", r.resume);
  describe(json, r.bounds);
  describe(json, r.outputs);
  describe(json, r.view);
  json.end_object();
}

Space space_of_output(const SegmentRequest& r, const Volume& volume) {
  switch (r.space) {
    case OutputSpace::ras: return Space::ras;
    case OutputSpace::lps: return Space::lps;
    case OutputSpace::voxel: return Space::unnamed;
    case OutputSpace::of_file: break;
  }
  return volume.space_of_file();
}

Affine output_map(const SegmentRequest& r, const Volume& volume) {
  if (r.space == OutputSpace::voxel) return inverse(volume.to_world);
  return space_of_output(r, volume) != volume.space ? turned_about_z(Affine()) : Affine();
}

Affine from_named_space(const SegmentRequest& r, const Volume& volume) {
  if (r.space == OutputSpace::voxel) return volume.is_turned ? turned_about_z(Affine()) : Affine();
  return inverse(output_map(r, volume));
}

}  // namespace tool
