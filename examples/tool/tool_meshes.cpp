// SPDX-License-Identifier: MIT
// topoadapt detect, resolve, validate
#include <algorithm>
#include <chrono>
#include <cstdio>

#include "tool/commands.h"

namespace tool {

namespace {

struct MeshCall {
  Arguments arguments;
  TriangleMesh mesh;
  Surface surface;
  std::string json_path;
  tpa_config config;
};

Status start(MeshCall& call, int count, const char* const* words, std::initializer_list<Option> known) {
  if (Status s = parse_arguments(count, words, known, call.arguments); !s) return s;
  if (Status s = expect_positionals(call.arguments, 1, 1, "one MESH"); !s) return s;
  if (Status s = read_text(call.arguments, "--json", call.json_path); !s) return s;
  SurfaceBounds bounds;
  if (Status s = read_bounds(call.arguments, bounds); !s) return s;
  call.surface.bound(bounds);
  return read_mesh(call.arguments.positionals[0], call.mesh);
}

Status load(MeshCall& call) {
  const auto vertices = static_cast<uint32_t>(call.mesh.positions.size() / 3);
  const auto triangles = static_cast<uint32_t>(call.mesh.triangles.size() / 3);
  call.config.max_vertices = vertices + vertices / 2 + 1024;
  call.config.max_triangles = std::max(2 * call.config.max_vertices + 1024, triangles + 1024);
  const Status s = call.surface.start(call.config, call.mesh);
  return s ? s : failure(call.arguments.positionals[0], ": ", s.message);
}

int finish(const MeshCall& call, const JsonWriter& json, bool yes) {
  if (Status s = write_json(call.json_path, json); !s) return refuse(s);
  return yes ? 0 : 1;
}

}  // namespace

int run_detect(int count, const char* const* words) {
  MeshCall call;
  tpa_config_init(&call.config, sizeof call.config);
  if (Status s = start(call, count, words,
                       {{"--mode", true},
                        {"--cell", true},
                        {"--pairs"},
                        {"--json", true},
                        {"--max-vertices", true},
                        {"--max-bytes", true}});
      !s)
    return refuse(s);
  std::string mode = "complete";
  if (Status s = read_text(call.arguments, "--mode", mode); !s) return refuse(s);
  if (Status s = read_real(call.arguments, "--cell", call.config.cell_size); !s) return refuse(s);
  if (mode != "complete" && mode != "vertex-hash") return refuse(failure("--mode is complete or vertex-hash"));
  if (mode == "vertex-hash") call.config.detect_mode = TPA_DETECT_VERTEX_HASH;
  if (Status s = load(call); !s) return refuse(s);
  tpa_contacts contacts{};
  contacts.struct_size = sizeof contacts;
  Status s =
      call.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_detect(c, nullptr, &contacts, issue); });
  if (!s) return refuse(s);
  if (call.arguments.has("--pairs"))
    for (uint32_t i = 0; i < contacts.count; ++i) std::printf("%u %u\n", contacts.pairs[i].a, contacts.pairs[i].b);
  else if (call.json_path != "-")
    std::printf("%u pairs\n", contacts.count);
  JsonWriter json;
  json.begin_object();
  describe_mesh(json, call.mesh);
  json.member("self_intersections", contacts.count).member("arena_bytes", call.surface.arena_bytes());
  json.member("peak_bytes", call.surface.peak_bytes()).end_object();
  return finish(call, json, contacts.count == 0);
}

int run_resolve(int count, const char* const* words) {
  MeshCall call;
  tpa_config_init(&call.config, sizeof call.config);
  if (Status s = start(call, count, words,
                       {{"--out", true}, {"--json", true}, {"--max-vertices", true}, {"--max-bytes", true}});
      !s)
    return refuse(s);
  std::string out;
  if (Status s = read_text(call.arguments, "--out", out); !s) return refuse(s);
  if (out.empty()) return refuse(failure("resolve needs --out MESH"));
  if (Status s = load(call); !s) return refuse(s);
  tpa_report report{};
  report.struct_size = sizeof report;
  const auto begin = std::chrono::steady_clock::now();
  if (Status s =
          call.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_adapt(c, nullptr, &report, issue); });
      !s)
    return refuse(s);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const TriangleMesh result = call.surface.copy();
  if (Status s = write_mesh(out, result); !s) return refuse(s);
  if (call.json_path != "-")
    std::printf("%u pairs, %u groups, %u left\n", report.contacts, report.groups, report.unresolved);
  JsonWriter json;
  json.begin_object();
  describe_mesh(json, result);
  json.member("self_intersections", report.unresolved);
  EventCounts events;
  events.add(call.surface.context(), report);
  describe(json, events);
  json.key("seconds").begin_object().member("total", seconds).member("adapt", seconds).end_object();
  json.member("arena_bytes", call.surface.arena_bytes()).member("peak_bytes", call.surface.peak_bytes()).end_object();
  return finish(call, json, report.unresolved == 0);
}

int run_validate(int count, const char* const* words) {
  MeshCall call;
  tpa_config_init(&call.config, sizeof call.config);
  if (Status s = start(call, count, words, {{"--json", true}, {"--max-vertices", true}, {"--max-bytes", true}}); !s)
    return refuse(s);
  if (Status s = load(call); !s) return refuse(s);
  tpa_validation v{};
  v.struct_size = sizeof v;
  if (Status s =
          call.surface.run([&](tpa_context* c, tpa_issue* issue) { return tpa_validate(c, nullptr, &v, issue); });
      !s)
    return refuse(s);
  if (call.json_path != "-")
    std::printf("%u components, genus %lld, %llu self-intersections\n", v.components, static_cast<long long>(v.genus),
                static_cast<unsigned long long>(v.self_intersections));
  JsonWriter json;
  json.begin_object();
  describe_mesh(json, call.mesh);
  json.member("self_intersections", v.self_intersections).member("genus", v.genus).member("volume", v.volume);
  json.member("area", v.area).end_object();
  return finish(call, json, v.self_intersections == 0);
}

}  // namespace tool
