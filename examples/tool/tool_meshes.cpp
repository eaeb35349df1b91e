// SPDX-License-Identifier: MIT
// topoadapt detect, resolve, validate
#include <cmath>
#include <cstdio>
#include <filesystem>

#include "tool/mend/soup.h"
#include "tool/mesh_call.h"

namespace tool {

namespace {

// The meshes before and after, with the triangles that meet.
Status start_film(MeshCall& call, Film& film) {
  tpa_contacts contacts{};
  contacts.struct_size = sizeof contacts;
  if (Status s =
          call.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_detect(c, nullptr, &contacts, issue); });
      !s)
    return s;
  std::vector<uint8_t> marks(call.mesh().triangles.size() / 3);
  for (uint32_t i = 0; i < contacts.count; ++i) marks[contacts.pairs[i].a] = marks[contacts.pairs[i].b] = 1;
  film.add(text_of("before, ", counted(contacts.count, "pair"), " of triangles that meet"), call.mesh(),
           std::move(marks));
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
  if (!call.is_open()) describe_memory(json, call.surface);
  json.key("options").begin_object();
  describe_options(json, call);
  if (call.takes_open) {
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
  call.takes_open = true;
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

// Of a closed mesh by the library, else by its predicates alone. Bodies with a common edge count as connected there, as
// they are in the file.
Status find_pairs(MeshCall& call, MeetingPairs& pairs) {
  const bool was_parted = !call.read.joined.triangles.empty() && call.config.detect_mode == TPA_DETECT_COMPLETE;
  const TriangleMesh& mesh = was_parted ? call.read.joined : call.mesh();
  if (call.is_open() || was_parted) {
    pairs = meeting_pairs(mesh);
  } else {
    tpa_contacts contacts{};
    contacts.struct_size = sizeof contacts;
    if (Status s = call.surface.run(
            [&](tpa_context* c, tpa_issue* issue) { return tpa_detect(c, nullptr, &contacts, issue); });
        !s)
      return s;
    for (uint32_t i = 0; i < contacts.count; ++i) pairs.emplace_back(contacts.pairs[i].a, contacts.pairs[i].b);
  }
  count_flat_triangles_once(mesh, pairs);
  return success();
}

// Triangles that fill a hole have no number in the file.
std::string number_in_file(const MeshCall& call, uint32_t triangle) {
  const uint32_t number = call.read.source[triangle];
  return number == UINT32_MAX ? "filling" : std::to_string(number);
}

void print_pairs(const MeshCall& call, const MeetingPairs& pairs) {
  if (!call.arguments.has("--pairs")) {
    if (call.outputs.summary_wanted()) std::printf("%s\n", counted(pairs.size(), "pair").c_str());
    return;
  }
  for (const auto& [a, b] : pairs)
    std::printf("%s %s\n", number_in_file(call, a).c_str(), number_in_file(call, b).c_str());
}

void print_resolved(const MeshCall& call, const tpa_report& report, bool kept) {
  if (!call.outputs.summary_wanted()) return;
  const double left_out = call.inside_out.left_out;
  const std::string beside = left_out > 0 ? text_of(" (beside ", left_out, " inside out)") : "";
  std::printf("%s, %u left; region %.6g before%s, %.6g after, %.2g lost, %.2g gained\n",
              counted(report.contacts, "pair").c_str(), report.unresolved, report.region_before, beside.c_str(),
              report.region_after, report.region_lost, report.region_gained);
  const size_t turned = call.inside_out.turned.size();
  if (turned > 0)
    std::printf("%s inside out, and the mesh was not written; --turn-parts turns %s\n",
                counted(turned, "component").c_str(), turned == 1 ? "it" : "them");
  else if (!kept)
    std::printf("the region was not kept, and the mesh was not written\n");
}

}  // namespace

int run_detect(int count, const char* const* words) {
  MeshCall call;
  if (Status s = read_call(call, count, words, {{"--mode", true}, {"--cell", true}, {"--pairs"}}); !s) return refuse(s);
  if (Status s = read_mode(call); !s) return refuse(s);
  if (Status s = load(call); !s) return refuse(s);
  if (call.is_open() && call.config.detect_mode != TPA_DETECT_COMPLETE)
    return refuse(failure(call.path, ": --mode vertex-hash needs a closed mesh"));
  const double begin = clock_seconds();
  MeetingPairs pairs;
  if (Status s = find_pairs(call, pairs); !s) return refuse(s);
  const double seconds = clock_seconds() - begin;
  print_pairs(call, pairs);
  JsonWriter json;
  begin_report(json);
  describe_mesh(json, call.mesh(), !call.is_open());
  json.member("self_intersections", pairs.size());
  describe_reading(json, call);
  return finish(call, json, "detect", seconds, pairs.empty());
}

int run_resolve(int count, const char* const* words) {
  MeshCall call;
  if (Status s = read_call(call, count, words, {{"--out", true}, {"--html", true}, {"--png", true}}); !s)
    return refuse(s);
  if (call.outputs.mesh.empty()) return refuse(failure("resolve needs --out MESH"));
  call.refuses_inside_out = true;
  if (Status s = load(call); !s) return refuse(s);
  // The region of winding number 1 or more would be empty, or what lies between crossing parts.
  if (call.inside_out.is_all) return refuse(failure(line_of_all_turned(call)));
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
  const bool kept = keeps_region(report) && call.inside_out.turned.empty();
  if (kept)
    if (Status s = write_mesh(call.outputs.mesh, result); !s) return refuse(s);
  print_resolved(call, report, kept);
  JsonWriter json;
  begin_report(json);
  describe_mesh(json, result);
  json.member("self_intersections", report.unresolved);
  EventCounts events;
  events.add(call.surface.context(), report);
  events.region.left_out = call.inside_out.left_out;
  describe(json, events);
  describe_reading(json, call);
  const int exit_code = finish(call, json, "adapt", seconds, report.unresolved == 0 && kept);
  // A picture of a result that was not written would pass for it.
  if (exit_code == 2 || !call.view.wanted() || !call.inside_out.turned.empty()) return exit_code;
  if (Status s = end_film(call, result, film, json.text()); !s) return refuse(s);
  return exit_code;
}

int run_validate(int count, const char* const* words) {
  MeshCall call;
  if (Status s = read_call(call, count, words, {}); !s) return refuse(s);
  if (Status s = load(call); !s) return refuse(s);
  tpa_validation v{};
  v.struct_size = sizeof v;
  const double begin = clock_seconds();
  if (Status s =
          call.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_validate(c, nullptr, &v, issue); });
      !s)
    return refuse(s);
  const double seconds = clock_seconds() - begin;
  if (call.outputs.summary_wanted())
    std::printf("%s, genus %lld, %s\n", counted(v.components, "component").c_str(), static_cast<long long>(v.genus),
                counted(v.self_intersections, "self-intersection").c_str());
  JsonWriter json;
  begin_report(json);
  describe_mesh(json, call.mesh());
  json.member("self_intersections", v.self_intersections).member("genus", v.genus).member("volume", v.volume);
  json.member("area", v.area);
  describe_reading(json, call);
  return finish(call, json, "detect", seconds, v.self_intersections == 0);
}

}  // namespace tool
