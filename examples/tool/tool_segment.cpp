// SPDX-License-Identifier: MIT
// topoadapt segment
#include <algorithm>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "tool/commands.h"
#include "tool/io/files.h"
#include "tool/io/output_file.h"
#include "tool/io/volume_io.h"
#include "tool/io/volume_write.h"
#include "tool/mend/crossings.h"
#include "tool/segment/outlook.h"
#include "tool/segment/request.h"
#include "tool/segment/segmentation.h"
#include "tool/segment/start.h"
#include "tool/tool_info.h"

namespace tool {

namespace {

// A mesh that holds a larger share of neighbours is no answer.
constexpr double largest_leak = 0.05;

volatile std::sig_atomic_t interrupted = 0;

// The second interrupt ends the program at once.
void interrupt(int) {
  interrupted = 1;
  std::signal(SIGINT, SIG_DFL);
}

// What suits the volume or phantom where the request names nothing.
void choose_options(const SegmentRequest& r, Segmentation& s) {
  BalloonOptions& o = s.options;
  if (!s.phantom) {
    o.edge_length = default_edge * mean_side(s.volume);
    o.radius = 0;
  }
  if (r.edge) {
    o.coarseness = 1;
    o.edge_thin = s.phantom ? *r.edge : 0;
    o.edge_fine = 0;
  }
  const auto take = [](const std::optional<double>& given, double& value) { value = given.value_or(value); };
  take(r.radius, o.radius);
  take(r.edge, o.edge_length);
  take(r.edge_fine, o.edge_fine);
  take(r.width, o.width);
  take(r.tension, o.tension);
  take(r.speed, o.speed);
  o.most_iterations = r.iterations;
  o.threads = static_cast<int>(r.threads);
  if (!r.voxel_seeds.empty() || !r.world_seeds.empty()) o.seeds.clear();
  for (const Point& p : r.world_seeds) o.seeds.push_back(from_named_space(r, s.volume)(p));
  for (const Point& p : r.voxel_seeds) o.seeds.push_back(s.volume.to_world(p));
  s.bounds = r.bounds;
}

// The first surface, where no balls are asked for.
Status prepare_start(const SegmentRequest& r, Segmentation& s) {
  if (!r.start_mask.empty()) return read_start_mask(r.start_mask, s.volume, s.options.first);
  if (!r.start_mesh.empty()) return read_start_mesh(r.start_mesh, inverse(output_map(r, s.volume)), s.options.first);
  if (starts_from_label(r)) s.options.first = label_surface(s.volume, *r.selection.label);
  const bool empty = starts_from_label(r) && s.options.first.triangles.empty();
  return empty ? failure("--label ", *r.selection.label, ": no voxel has this value") : success();
}

Status read_image(const SegmentRequest& r, Segmentation& s) {
  const Status made =
      r.phantom.empty() ? read_volume(r.volume, r.reading, s.volume) : prepare_phantom(r.phantom, r.noise_seed, s);
  if (!made) return made;
  if (!s.volume.note.empty()) note(r.outputs, s.volume.note);
  turn_to_lps(s.volume);
  const bool named = r.space == OutputSpace::ras || r.space == OutputSpace::lps;
  if (named && s.volume.space == Space::unnamed)
    return failure("--space: ", r.phantom.empty() ? r.volume : r.phantom,
                   " names neither RAS nor LPS; only voxel is left");
  return success();
}

Status prepare(const SegmentRequest& r, Segmentation& s) {
  choose_options(r, s);
  if (Status made = prepare_start(r, s); !made) return made;
  if (!r.resume.empty())
    if (Status read = read_file(r.resume, s.resumed.bytes); !read) return read;
  Selection selection = r.selection;
  if (!selection.is_given()) selection.threshold = s.options.threshold.value;
  return select(selection, r.sigma, s.volume, s.options.threshold, Workers(s.options.threads));
}

const char* name_of_output(const SegmentRequest& r, const Volume& volume) {
  return r.space == OutputSpace::voxel ? "voxel" : name_of(space_of_output(r, volume));
}

// The mesh in the space asked for, wound outwards there.
TriangleMesh in_output_space(const SegmentRequest& r, const Volume& volume, TriangleMesh mesh) {
  const Affine map = output_map(r, volume);
  for (size_t v = 0; v < mesh.positions.size(); v += 3) {
    const Point p = map({mesh.positions[v], mesh.positions[v + 1], mesh.positions[v + 2]});
    std::copy(p.begin(), p.end(), &mesh.positions[v]);
  }
  if (determinant(map) < 0) turn_round(mesh);
  mesh.space = space_of_output(r, volume);
  return mesh;
}

Status write_frame(const SegmentRequest& r, const Segmentation& s, uint64_t iteration) {
  if (r.every == 0 || iteration % r.every != 0) return success();
  char name[40];
  std::snprintf(name, sizeof name, "/frame-%06llu.ply", static_cast<unsigned long long>(iteration));
  return write_mesh(r.frames + name, in_output_space(r, s.volume, s.surface.copy()));
}

// Percent, never rounded up.
double percent(double share) { return std::floor(1000 * share) / 10; }

Status run(const SegmentRequest& r, Segmentation& s, Film& film) {
  Progress progress(r.outputs.quiet);
  BalloonWatch watch;
  Outlook outlook;
  const double start = clock_seconds();
  watch.progress = [&](uint64_t iteration, uint32_t vertices, double resting, double volume) {
    const double of_object = static_cast<double>(s.object.voxels) * std::fabs(determinant(s.volume.to_world));
    outlook.note(clock_seconds() - start, volume / of_object);
    progress.show(text_of_progress(iteration, vertices, volume / of_object, resting, outlook.seconds_left()));
  };
  watch.interrupted = [] { return interrupted != 0; };
  if (r.every > 0 || r.view.wanted())
    watch.frame = [&](uint64_t iteration) {
      if (r.view.wanted()) film.add(static_cast<double>(iteration), s.surface.copy(), s.result.events);
      return write_frame(r, s, iteration);
    };
  const auto announce = [&](const Segmentation& now, const Pass& pass) {
    note(r.outputs, text_of("filled ", percent(now.filling.enclosed_share()), " % with ", now.mesh.positions.size() / 3,
                            " vertices; going on with edges down to ", pass.shortest, " mm round ", pass.missing,
                            " voxels left out (--edge-fine ", now.options.edge_length, " keeps longer edges)"));
  };
  return run_segmentation(s, watch, r.drop_below, announce);
}

std::string text_of_pieces(const std::vector<Piece>& pieces) {
  std::string text;
  for (size_t i = 0; i < std::min<size_t>(3, pieces.size()); ++i) {
    const Piece& p = pieces[i];
    text += text_of(i > 0 ? "; " : "", p.voxels, " voxels round voxel ", p.voxel.i, ",", p.voxel.j, ",", p.voxel.k,
                    " (", p.world[0], ",", p.world[1], ",", p.world[2], " mm)");
  }
  return text;
}

// Why the answer is "no", a line for each reason.
std::vector<std::string> objections(const SegmentRequest& r, const Segmentation& s) {
  std::vector<std::string> lines;
  const Filling& f = s.filling;
  const double leak = static_cast<double>(f.foreign) / static_cast<double>(std::max<uint64_t>(1, f.object));
  if (s.self_intersections > 0) lines.push_back("triangles meet");
  if (r.genus && genus_of(s.parts) != *r.genus)
    lines.push_back(text_of("the genus is ", genus_of(s.parts), ", not ", *r.genus));
  if (leak > largest_leak)
    lines.push_back(text_of("the surface leaks into neighbours: ", text_of_pieces(f.neighbours)));
  if (r.partial) return lines;
  if (s.result.ended == Ended::interrupted) lines.push_back("interrupted: the mesh is as far as the balloon came");
  if (s.result.ended == Ended::iterations)
    lines.push_back(
        text_of("cut short by --iterations ", s.options.most_iterations, ": the mesh is as far as the balloon came"));
  if (s.result.ended == Ended::limit)
    lines.push_back(text_of("the mesh is as far as the balloon came: ", s.result.limit));
  if (f.share() < least_share)
    lines.push_back(text_of("filled ", percent(f.share()), " % of the object, less than ", 100 * least_share,
                            " %; left out: ", text_of_pieces(f.left_out)));
  return lines;
}

// "3 to 40", or "3" where all are the same.
std::string text_of_range(std::initializer_list<int64_t> numbers) {
  const auto [low, high] = std::minmax(numbers);
  return low == high ? text_of(low) : text_of(low, " to ", high);
}

void note_topology(const SegmentRequest& r, const Segmentation& s) {
  const NoiseRange& n = s.noise_range;
  const auto surfaces = [](const VoxelTopology& t) { return static_cast<int64_t>(t.surfaces); };
  char shift[32];
  std::snprintf(shift, sizeof shift, "%.3g", n.shift);
  if (!n.is_sure())
    note(r.outputs, text_of("noise decides on the topology: with grey values ", shift,
                            " to either side of the threshold the object's voxels have genus ",
                            text_of_range({n.surest.genus, n.object.genus, n.uncertain.genus}), " in ",
                            text_of_range({surfaces(n.surest), surfaces(n.object), surfaces(n.uncertain)}),
                            " surfaces (--sigma smooths noise)"));
  else if (genus_of(s.parts) != n.object.genus)
    note(r.outputs, text_of("the genus is ", genus_of(s.parts), ", that of the object's voxels ", n.object.genus));
}

void note_what_is_odd(const SegmentRequest& r, const Segmentation& s) {
  const std::string first = s.options.first.triangles.empty()
                                ? text_of("the first ball of radius ", s.options.radius, " mm")
                                : "the first surface";
  if (s.balls.outside() > 0)
    note(r.outputs,
         text_of(first, " reaches outside the object: ", s.balls.outside(), " of its ", s.balls.voxels, " voxels"));
  if (s.filling.foreign > 0)
    note(r.outputs,
         text_of("neighbours beyond the object are enclosed in part: ", text_of_pieces(s.filling.neighbours)));
  note_topology(r, s);
}

void print_summary(const Segmentation& s) {
  std::printf("%s, %.2f s, %zu vertices, %s, genus %lld, %s, filled %.1f %% of the object\n",
              counted(s.result.iterations, "iteration").c_str(), s.result.seconds.total, s.mesh.positions.size() / 3,
              counted(s.parts.size(), "component").c_str(), static_cast<long long>(genus_of(s.parts)),
              counted(s.self_intersections, "self-intersection").c_str(), percent(s.filling.share()));
}

Status write_page(const SegmentRequest& r, const Segmentation& s, Film& film, const JsonWriter& report) {
  if (!r.view.wanted()) return success();
  film.end(static_cast<double>(s.result.iterations), s.mesh);
  PageContent c;
  c.command = "segment";
  c.title = r.phantom.empty() ? std::filesystem::path(r.volume).filename().string() : "phantom " + r.phantom;
  c.report = report.text();
  c.time_name = "iteration";
  c.unit = r.space == OutputSpace::voxel ? "" : "mm";
  c.space = space_of_output(r, s.volume);
  c.film = &film;
  c.volume = &s.volume;
  c.threshold = s.options.threshold.value;
  if (s.dropped > 0) c.notes.push_back(text_of(s.dropped, " components below --drop-below in the last mesh"));
  return write_view(r.view, c);
}

Status write_mask(const std::string& path, const Segmentation& s) {
  const std::vector<uint8_t> mask = enclosed_voxels(s.volume, s.mesh);
  return write_labels(path, s.volume, {mask.begin(), mask.end()});
}

// The members of the report on one object.
void describe_all(JsonWriter& json, const SegmentRequest& r, const Segmentation& s,
                  const std::vector<std::string>& reasons) {
  describe(json, s);
  json.member("space", name_of_output(r, s.volume));
  json.key("objections").begin_array();
  for (const std::string& line : reasons) json.value(line);
  json.end_array();
  describe(json, r, s);
}

Status write_results(const SegmentRequest& r, const Segmentation& s, Film& film,
                     const std::vector<std::string>& reasons) {
  JsonWriter json;
  begin_report(json);
  describe_all(json, r, s, reasons);
  json.end_object();
  if (!r.outputs.mesh.empty())
    if (Status w = write_mesh(r.outputs.mesh, in_output_space(r, s.volume, s.mesh)); !w) return w;
  if (!r.mask.empty())
    if (Status w = write_mask(r.mask, s); !w) return w;
  if (!r.save.empty() && !s.left.bytes.empty())
    if (Status w = write_file(r.save, s.left.bytes); !w) return w;
  if (Status w = write_page(r, s, film, json); !w) return w;
  return write_json(r.outputs.json, json);
}

// The results of all labels.
struct LabelResults {
  TriangleMesh mesh;  // of all
  std::vector<int32_t> mask;
  JsonWriter json;
  bool good = true;
};

void append(const TriangleMesh& mesh, int32_t label, TriangleMesh& all) {
  const auto first = static_cast<uint32_t>(all.positions.size() / 3);
  all.space = mesh.space;
  all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
  for (const uint32_t v : mesh.triangles) all.triangles.push_back(first + v);
  all.labels.resize(all.triangles.size() / 3, label);
}

// "liver-%d.ply" for label 3 is "liver-3.ply"; empty for a name without %d.
std::string name_for_label(const std::string& pattern, int32_t label) {
  const size_t at = pattern.find("%d");
  return at == std::string::npos ? "" : pattern.substr(0, at) + std::to_string(label) + pattern.substr(at + 2);
}

// A label that fails is reported, and the others go on.
Status segment_label(const SegmentRequest& r, Segmentation& s, int32_t label, LabelResults& results) {
  results.json.begin_object().member("label", label);
  Film film;
  Status done = prepare(r, s);
  if (done) done = run(r, s, film);
  std::vector<std::string> reasons = done ? objections(r, s) : std::vector<std::string>{done.message};
  for (const std::string& line : reasons) note(r.outputs, text_of("label ", label, ": ", line));
  results.good = results.good && reasons.empty();
  if (done) {
    describe_all(results.json, r, s, reasons);
  } else {
    results.json.key("objections").begin_array().value(done.message).end_array();
  }
  results.json.end_object();
  if (!done) return success();
  if (r.outputs.summary_wanted()) {
    std::printf("label %d: ", label);
    print_summary(s);
  }
  const std::vector<uint8_t> inside = r.mask.empty() ? std::vector<uint8_t>() : enclosed_voxels(s.volume, s.mesh);
  results.mask.resize(inside.size());
  for (size_t id = 0; id < inside.size(); ++id)
    if (inside[id] != 0) results.mask[id] = label;
  const TriangleMesh mesh = in_output_space(r, s.volume, s.mesh);
  append(mesh, label, results.mesh);
  const std::string own = name_for_label(r.outputs.mesh, label);
  return own.empty() ? success() : write_mesh(own, mesh);
}

// Meshes are made apart, so that neighbours may cross; each mesh's own line cannot tell.
void tell_crossings(const SegmentRequest& r, size_t labels, LabelResults& results) {
  const Crossings found = count_crossings(results.mesh);
  results.json.key("crossings").begin_object().member("triangle_pairs", found.triangles);
  results.json.member("label_pairs", found.labels).end_object();
  if (!r.outputs.summary_wanted()) return;
  if (found.triangles == 0)
    std::printf("%s: no meshes of different labels meet\n", counted(labels, "label").c_str());
  else
    std::printf("%s: meshes of %s meet each other, in %s of triangles\n", counted(labels, "label").c_str(),
                counted(found.labels, "pair").c_str(), counted(found.triangles, "pair").c_str());
}

Status write_label_results(const SegmentRequest& r, const Volume& volume, LabelResults& results) {
  const bool one_file = !r.outputs.mesh.empty() && name_for_label(r.outputs.mesh, 0).empty();
  if (one_file)
    if (Status w = write_mesh(r.outputs.mesh, results.mesh); !w) return w;
  results.mask.resize(volume.voxels());
  if (!r.mask.empty())
    if (Status w = write_labels(r.mask, volume, results.mask); !w) return w;
  return write_json(r.outputs.json, results.json);
}

int segment_all_labels(const SegmentRequest& request) {
  constexpr size_t most_labels = 4096;
  Segmentation read;
  if (Status status = read_image(request, read); !status) return refuse(status);
  std::vector<int32_t> labels;
  if (Status status = find_labels(read.volume, most_labels, labels); !status)
    return refuse(failure(request.volume, ": ", status.message));
  LabelResults results;
  begin_report(results.json);
  results.json.key("labels").begin_array();
  for (const int32_t label : labels) {
    if (interrupted != 0) break;
    Segmentation s;
    s.volume = read.volume;
    SegmentRequest one = request;
    one.selection.label = label;
    if (Status status = segment_label(one, s, label, results); !status) return refuse(status);
  }
  results.json.end_array();
  tell_crossings(request, labels.size(), results);
  results.json.end_object();
  if (Status status = write_label_results(request, read.volume, results); !status) return refuse(status);
  return results.good && interrupted == 0 ? 0 : 1;
}

}  // namespace

int run_segment(int count, const char* const* words) {
  SegmentRequest request;
  if (Status status = read_request(count, words, request); !status) return refuse(status);
  std::signal(SIGINT, interrupt);
  if (request.all_labels) return segment_all_labels(request);
  Segmentation s;
  if (Status status = read_image(request, s); !status) return refuse(status);
  if (request.info) return run_info(request, s.volume);
  if (Status status = prepare(request, s); !status) return refuse(status);
  Film film;
  film.map = output_map(request, s.volume);
  if (Status status = run(request, s, film); !status) return refuse(status);
  const std::vector<std::string> reasons = objections(request, s);
  note_what_is_odd(request, s);
  for (const std::string& line : reasons) note(request.outputs, line);
  if (Status status = write_results(request, s, film, reasons); !status) return refuse(status);
  if (request.outputs.summary_wanted()) print_summary(s);
  return reasons.empty() ? 0 : 1;
}

}  // namespace tool
