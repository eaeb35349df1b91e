// SPDX-License-Identifier: MIT
// topoadapt detect, resolve, validate
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tool/commands.h"
#include "tool/view/view.h"

namespace tool {

namespace {

struct MeshCall {
  Arguments arguments;
  Outputs outputs;
  ViewOutputs view;
  SurfaceBounds bounds;
  TriangleMesh mesh;
  Surface surface;
  tpa_config config;
  std::string path;
  double begin = clock_seconds();
  bool detects = false, turned = false, inside_out = false;
  double volume = 0;  // signed
};

Status read_call(MeshCall& call, int count, const char* const* words, std::initializer_list<Option> known) {
  tpa_config_init(&call.config, sizeof call.config);
  if (Status s = parse_arguments(count, words, known, call.arguments); !s) return s;
  if (Status s = expect_positionals(call.arguments, 1, 1, "one MESH"); !s) return s;
  call.path = call.arguments.positionals[0];
  call.turned = call.arguments.has("--turn");
  if (Status s = read_bounds(call.arguments, call.bounds); !s) return s;
  if (Status s = read_outputs(call.arguments, call.outputs); !s) return s;
  return read_view(call.arguments, call.outputs, call.view);
}

// Reads the mesh and loads it.
Status load(MeshCall& call) {
  if (Status s = read_mesh(call.path, call.mesh); !s) return s;
  const size_t cleared = clear_tiny_coordinates(call.mesh);
  if (call.turned) turn_round(call.mesh);
  const auto vertices = static_cast<uint32_t>(call.mesh.positions.size() / 3);
  const auto triangles = static_cast<uint32_t>(call.mesh.triangles.size() / 3);
  call.config.max_vertices = vertices + vertices / 2 + 1024;
  call.config.max_triangles = std::max(2 * call.config.max_vertices + 1024, triangles + 1024);
  call.surface.bound(call.bounds);
  if (Status s = call.surface.start(call.config, call.mesh); !s) return failure(call.path, ": ", s.message);
  call.inside_out = is_inside_out(call.mesh, call.volume);
  if (cleared > 0)
    note(call.outputs, text_of(call.path, ": ", cleared, cleared == 1 ? " coordinate" : " coordinates",
                               " of magnitude below 2^-100 (7.9e-31) read as 0"));
  return success();
}

std::string inside_out_line(const MeshCall& call) {
  return text_of(call.path, ": the mesh is inside out", call.turned ? " once turned" : "", ", its signed volume is ",
                 call.volume, call.turned ? "; leave out --turn" : "; --turn turns every triangle round");
}

// The meshes before and after, with the triangles that meet.
Status start_film(MeshCall& call, Film& film) {
  tpa_contacts contacts{};
  contacts.struct_size = sizeof contacts;
  if (Status s =
          call.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_detect(c, nullptr, &contacts, issue); });
      !s)
    return s;
  std::vector<uint8_t> marks(call.mesh.triangles.size() / 3);
  for (uint32_t i = 0; i < contacts.count; ++i) marks[contacts.pairs[i].a] = marks[contacts.pairs[i].b] = 1;
  film.add(text_of("before, ", contacts.count, " pairs of triangles that meet"), call.mesh, std::move(marks));
  return success();
}

Status end_film(const MeshCall& call, const TriangleMesh& result, Film& film, const std::string& report) {
  film.add("after", result, {});
  PageContent c;
  c.command = "resolve";
  c.title = std::filesystem::path(call.path).filename().string();
  c.report = report;
  c.film = &film;
  return write_view(call.view, c);
}

// With the seconds since the start, and those of the work, under its name.
int finish(const MeshCall& call, JsonWriter& json, const char* work, double seconds, bool yes) {
  json.key("seconds").begin_object().member("total", clock_seconds() - call.begin).member(work, seconds).end_object();
  describe_memory(json, call.surface);
  json.key("options").begin_object().member("mesh", call.path).member("turn", call.turned);
  if (call.detects) {
    json.member("mode", call.config.detect_mode == TPA_DETECT_COMPLETE ? "complete" : "vertex-hash");
    json.member("cell", call.config.cell_size).member("pairs", call.arguments.has("--pairs"));
  }
  describe(json, call.bounds);
  describe(json, call.outputs);
  if (work == std::string_view("adapt")) describe(json, call.view);
  json.end_object().end_object();
  if (Status s = write_json(call.outputs.json, json); !s) return refuse(s);
  return yes ? 0 : 1;
}

Status read_mode(MeshCall& call) {
  call.detects = true;
  std::string mode = "complete";
  if (Status s = read_text(call.arguments, "--mode", mode); !s) return s;
  if (Status s = read_real(call.arguments, "--cell", call.config.cell_size); !s) return s;
  if (mode != "complete" && mode != "vertex-hash") return failure("--mode is complete or vertex-hash");
  if (!(call.config.cell_size > 0)) return failure("--cell must be positive");
  if (mode == "vertex-hash") call.config.detect_mode = TPA_DETECT_VERTEX_HASH;
  if (call.arguments.has("--pairs") && call.outputs.json == "-")
    return failure("--pairs and --json - both write to standard output");
  return success();
}

// Of the region's volume, so much may be lost and gained together: where the region touches itself, its parts come
// apart.
constexpr double most_changed = 0.01;
bool keeps_region(const tpa_report& report) {
  return report.region_lost + report.region_gained <= most_changed * std::fabs(report.region_before);
}

}  // namespace

int run_detect(int count, const char* const* words) {
  MeshCall call;
  if (Status s = read_call(call, count, words,
                           {{"--mode", true},
                            {"--cell", true},
                            {"--pairs"},
                            {"--turn"},
                            {"--json", true},
                            {"--max-vertices", true},
                            {"--max-bytes", true},
                            {"--quiet"}});
      !s)
    return refuse(s);
  if (Status s = read_mode(call); !s) return refuse(s);
  if (Status s = load(call); !s) return refuse(s);
  if (call.inside_out) note(call.outputs, inside_out_line(call));
  tpa_contacts contacts{};
  contacts.struct_size = sizeof contacts;
  const double begin = clock_seconds();
  Status s =
      call.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_detect(c, nullptr, &contacts, issue); });
  if (!s) return refuse(s);
  const double seconds = clock_seconds() - begin;
  if (call.arguments.has("--pairs"))
    for (uint32_t i = 0; i < contacts.count; ++i) std::printf("%u %u\n", contacts.pairs[i].a, contacts.pairs[i].b);
  else if (call.outputs.summary_wanted())
    std::printf("%u pairs\n", contacts.count);
  JsonWriter json;
  json.begin_object();
  describe_mesh(json, call.mesh);
  json.member("self_intersections", contacts.count);
  return finish(call, json, "detect", seconds, contacts.count == 0);
}

int run_resolve(int count, const char* const* words) {
  MeshCall call;
  if (Status s = read_call(call, count, words,
                           {{"--out", true},
                            {"--turn"},
                            {"--json", true},
                            {"--html", true},
                            {"--png", true},
                            {"--max-vertices", true},
                            {"--max-bytes", true},
                            {"--quiet"}});
      !s)
    return refuse(s);
  if (call.outputs.mesh.empty()) return refuse(failure("resolve needs --out MESH"));
  if (Status s = load(call); !s) return refuse(s);
  // The region of winding number 1 or more would be empty, or what lies between crossing parts.
  if (call.inside_out) return refuse(failure(inside_out_line(call)));
  Film film;
  if (call.view.wanted())
    if (Status s = start_film(call, film); !s) return refuse(s);
  tpa_report report{};
  report.struct_size = sizeof report;
  const double begin = clock_seconds();
  if (Status s =
          call.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_adapt(c, nullptr, &report, issue); });
      !s)
    return refuse(s);
  const double seconds = clock_seconds() - begin;
  const TriangleMesh result = call.surface.copy();
  const bool kept = keeps_region(report);
  if (kept)
    if (Status s = write_mesh(call.outputs.mesh, result); !s) return refuse(s);
  if (call.outputs.summary_wanted()) {
    std::printf("%u pairs, %u left; region %.6g before, %.6g after, %.2g lost, %.2g gained\n", report.contacts,
                report.unresolved, report.region_before, report.region_after, report.region_lost, report.region_gained);
    if (!kept) std::printf("the region was not kept, and nothing was written\n");
  }
  JsonWriter json;
  json.begin_object();
  describe_mesh(json, result);
  json.member("self_intersections", report.unresolved);
  EventCounts events;
  events.add(call.surface.context(), report);
  describe(json, events);
  const int exit_code = finish(call, json, "adapt", seconds, report.unresolved == 0 && kept);
  if (exit_code == 2 || !call.view.wanted()) return exit_code;
  if (Status s = end_film(call, result, film, json.text()); !s) return refuse(s);
  return exit_code;
}

int run_validate(int count, const char* const* words) {
  MeshCall call;
  if (Status s =
          read_call(call, count, words,
                    {{"--turn"}, {"--json", true}, {"--max-vertices", true}, {"--max-bytes", true}, {"--quiet"}});
      !s)
    return refuse(s);
  if (Status s = load(call); !s) return refuse(s);
  if (call.inside_out) note(call.outputs, inside_out_line(call));
  tpa_validation v{};
  v.struct_size = sizeof v;
  const double begin = clock_seconds();
  if (Status s =
          call.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_validate(c, nullptr, &v, issue); });
      !s)
    return refuse(s);
  const double seconds = clock_seconds() - begin;
  if (call.outputs.summary_wanted())
    std::printf("%u components, genus %lld, %llu self-intersections\n", v.components, static_cast<long long>(v.genus),
                static_cast<unsigned long long>(v.self_intersections));
  JsonWriter json;
  json.begin_object();
  describe_mesh(json, call.mesh);
  json.member("self_intersections", v.self_intersections).member("genus", v.genus).member("volume", v.volume);
  json.member("area", v.area);
  return finish(call, json, "detect", seconds, v.self_intersections == 0);
}

}  // namespace tool
