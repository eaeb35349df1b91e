// SPDX-License-Identifier: MIT
// topoadapt evolve
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "tool/commands.h"
#include "tool/scenes/evolution.h"
#include "tool/view/view.h"

namespace tool {

namespace {

struct EvolveCall {
  Arguments arguments;
  EvolutionOptions options;
  uint64_t seed = 1, renumber = 0, turn = 0, steps = UINT64_MAX;
  Outputs outputs;
  ViewOutputs view;
};

Status read_call(int count, const char* const* words, EvolveCall& call) {
  Arguments& a = call.arguments;
  if (Status s = parse_arguments(count, words,
                                 {{"--list"},
                                  {"--seed", true},
                                  {"--renumber", true},
                                  {"--turn", true},
                                  {"--steps", true},
                                  {"--stride", true},
                                  {"--no-substeps"},
                                  {"--out", true},
                                  {"--json", true},
                                  {"--html", true},
                                  {"--png", true},
                                  {"--max-vertices", true},
                                  {"--max-bytes", true},
                                  {"--quiet"}},
                                 a);
      !s)
    return s;
  for (Status s : {read_unsigned(a, "--seed", call.seed), read_unsigned(a, "--renumber", call.renumber),
                   read_unsigned(a, "--turn", call.turn), read_unsigned(a, "--steps", call.steps),
                   read_real(a, "--stride", call.options.stride), read_outputs(a, call.outputs),
                   read_bounds(a, call.options.bounds)})
    if (!s) return s;
  if (Status s = read_view(a, call.outputs, call.view); !s) return s;
  call.options.substeps = !a.has("--no-substeps");
  if (call.turn > 23) return failure("--turn must be from 0 to 23");
  if (call.options.stride < 0) return failure("--stride must not be negative");
  const size_t names = a.has("--list") ? 0 : 1;
  return expect_positionals(a, names, names, names == 0 ? "no SCENE beside --list" : "one SCENE, or --list");
}

int list_scenes() {
  for (const SceneKind& kind : scene_kinds()) std::printf("%-18s %s\n", kind.name, kind.line);
  return 0;
}

std::vector<long> genera_of(const std::vector<Part>& parts) {
  std::vector<long> genera;
  for (const Part& p : parts) genera.push_back(p.genus);
  std::sort(genera.begin(), genera.end());
  return genera;
}

void describe(JsonWriter& json, const Evolution& e) {
  json.member("iterations", e.steps).member("substeps", e.substeps).member("long_steps", e.long_steps);
  json.member("steps_with_rollback", e.steps_with_rollback).member("longest_stall", e.longest_stall);
  describe(json, e.events);
  const Evolution::Seconds& t = e.seconds;
  json.key("seconds").begin_object().member("total", t.total).member("detect", t.detect).member("adapt", t.adapt);
  json.member("remesh", t.remesh).member("evolve", t.evolve).end_object();
}

void describe_options(JsonWriter& json, const EvolveCall& call) {
  const Arguments& a = call.arguments;
  const auto member_if_given = [&](const char* name, bool given, uint64_t value) {
    given ? json.member(name, value) : json.key(name).null();
  };
  json.key("options").begin_object().member("scene", a.positionals[0]).member("seed", call.seed);
  member_if_given("renumber", a.has("--renumber"), call.renumber);
  member_if_given("turn", a.has("--turn"), call.turn);
  member_if_given("steps", a.has("--steps"), call.steps);
  json.member("stride", call.options.stride).member("substeps", call.options.substeps);
  describe(json, call.options.bounds);
  describe(json, call.outputs);
  describe(json, call.view);
  json.end_object();
}

bool is_as_expected(const Scene& scene, const std::vector<Part>& parts) {
  double volume = 0;
  for (const Part& p : parts) volume += p.volume;
  return (!scene.end || scene.end->genera == genera_of(parts)) &&
         (scene.volume <= 0 || std::fabs(volume / scene.volume - 1) <= scene.volume_tolerance);
}

Status write_page(const EvolveCall& call, const Evolution& e, const TriangleMesh& mesh, Film& film,
                  const JsonWriter& report) {
  if (!call.view.wanted()) return success();
  film.end(e.time, mesh);
  PageContent c;
  c.command = "evolve";
  c.title = "scene " + call.arguments.positionals[0];
  c.report = report.text();
  c.time_name = "time";
  c.film = &film;
  return write_view(call.view, c);
}

// Writes mesh and report. Returns 1 for a mesh in contact with itself, or with another topology or volume than expected
// at the end of the scene.
int finish(const EvolveCall& call, const Scene& scene, const Evolution& e, Surface& surface, Film& film) {
  const TriangleMesh mesh = surface.copy();
  const std::vector<Part> parts = parts_of(mesh);
  tpa_validation v{};
  v.struct_size = sizeof v;
  if (Status s = surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_validate(c, nullptr, &v, issue); }); !s)
    return refuse(s);
  const bool known = (scene.end || scene.volume > 0) && end_is_known(scene, call.options, e);
  const bool as_expected = !known || is_as_expected(scene, parts);
  JsonWriter json;
  begin_report(json);
  describe_mesh(json, mesh);
  json.member("self_intersections", v.self_intersections);
  if (known) json.member("as_expected", as_expected);
  describe(json, e);
  describe_memory(json, surface);
  describe_options(json, call);
  json.end_object();
  if (!call.outputs.mesh.empty())
    if (Status s = write_mesh(call.outputs.mesh, mesh); !s) return refuse(s);
  if (Status s = write_page(call, e, mesh, film, json); !s) return refuse(s);
  if (Status s = write_json(call.outputs.json, json); !s) return refuse(s);
  if (call.outputs.summary_wanted())
    std::printf("%s, %.2f s, %zu vertices, %s, genus %lld, %s%s\n", counted(e.steps, "step").c_str(), e.seconds.total,
                mesh.positions.size() / 3, counted(parts.size(), "component").c_str(), static_cast<long long>(v.genus),
                counted(v.self_intersections, "self-intersection").c_str(),
                as_expected ? "" : "; not what the scene should end in");
  return v.self_intersections == 0 && as_expected ? 0 : 1;
}

}  // namespace

int run_evolve(int count, const char* const* words) {
  EvolveCall call;
  if (Status s = read_call(count, words, call); !s) return refuse(s);
  if (call.arguments.has("--list")) return list_scenes();
  Scene scene;
  if (Status s = make_scene(call.arguments.positionals[0], call.seed, scene); !s) return refuse(s);
  if (call.arguments.has("--renumber")) scene = renumbered(scene, call.renumber);
  if (call.arguments.has("--turn")) scene = turned(scene, static_cast<int>(call.turn));
  Surface surface;
  Evolution evolution;
  Film film;
  if (call.view.wanted()) film.add(0, scene.mesh, {});
  {
    Progress progress(call.outputs.quiet);
    const Status played = evolve(
        scene, call.options,
        [&](const Surface& now, const Evolution& e) {
          char line[120];
          std::snprintf(line, sizeof line, "time %.4g of %.4g, step %u, %u vertices", e.time, scene.duration, e.steps,
                        now.view().vertex_count);
          progress.show(line);
          if (call.view.wanted()) film.add(e.time, now.copy(), e.events);
          return e.steps < call.steps;
        },
        surface, evolution);
    if (!played) return refuse(played);
  }
  return finish(call, scene, evolution, surface, film);
}

}  // namespace tool
