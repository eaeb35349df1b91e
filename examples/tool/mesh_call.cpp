// SPDX-License-Identifier: MIT
#include "tool/mesh_call.h"

#include <algorithm>

#include "tool/mend/exact.h"

namespace tool {

namespace {

Status read_clean_options(MeshCall& call) {
  const Arguments& a = call.arguments;
  if (Status s = read_real(a, "--weld", call.clean.weld); !s) return s;
  if (a.has("--weld") && !(call.clean.weld > 0)) return failure("--weld must be positive");
  if (Status s = read_unsigned(a, "--fill", call.clean.fill); !s) return s;
  if (a.has("--fill") && (call.clean.fill < 3 || call.clean.fill > longest_loop))
    return failure("--fill must be from 3 to ", longest_loop);
  call.as_is = a.has("--as-is");
  call.turns_all = a.has("--turn");
  call.turns_parts = a.has("--turn-parts");
  for (const char* cleans : {"--weld", "--fill", "--turn", "--turn-parts"})
    if (call.as_is && a.has(cleans)) return failure("--as-is and ", cleans, " exclude each other");
  if (call.turns_all && call.turns_parts) return failure("one of --turn and --turn-parts is enough");
  return success();
}

// Facets of a format without numbers of vertices have to be welded.
Status check_as_is(const MeshCall& call) {
  Cleaning needed = call.read.cleaning;
  if (!call.read.has_numbers) needed.welded = 0;
  if (!call.as_is || needed.is_nothing()) return success();
  std::string lines;
  for (const std::string& line : lines_of(needed)) lines += (lines.empty() ? "" : "; ") + line;
  return failure(call.path, ": not as the library takes it (--as-is): without the option, ", lines);
}

std::string text_of_part(const TurnedPart& t) {
  const auto &low = t.part.low, &high = t.part.high;
  return text_of("component ", t.component, " is inside out, and no outward component contains it: box (", low[0], ",",
                 low[1], ",", low[2], ") to (", high[0], ",", high[1], ",", high[2], "), volume ", t.part.volume);
}

void note_inside_out(const MeshCall& call) {
  const InsideOut& found = call.inside_out;
  if (call.parts_turned > 0)
    note(call.outputs, text_of(call.path, ": ", counted(call.parts_turned, "component"), " turned"));
  if (found.turned.empty()) return;
  if (found.is_all) {
    if (!call.refuses_inside_out) note(call.outputs, line_of_all_turned(call));
    return;
  }
  constexpr size_t most_named = 10;
  for (size_t i = 0; i < std::min(most_named, found.turned.size()); ++i)
    note(call.outputs, text_of(call.path, ": ", text_of_part(found.turned[i]), "; --turn-parts turns it"));
  if (found.turned.size() > most_named)
    note(call.outputs, text_of(call.path, ": ", found.turned.size() - most_named, " more are inside out"));
}

Status start(MeshCall& call) {
  const auto vertices = static_cast<uint32_t>(call.mesh().positions.size() / 3);
  const auto triangles = static_cast<uint32_t>(call.mesh().triangles.size() / 3);
  call.config.max_vertices = vertices + vertices / 2 + 1024;
  call.config.max_triangles = std::max(2 * call.config.max_vertices + 1024, triangles + 1024);
  call.surface.bound(call.bounds);
  if (Status s = call.surface.start(call.config, call.mesh()); !s) return failure(call.path, ": ", s.message);
  return success();
}

}  // namespace

Status read_call(MeshCall& call, int count, const char* const* words, const std::vector<Option>& own) {
  std::vector<Option> known = {{"--turn"},  {"--turn-parts"}, {"--weld", true},         {"--fill", true},
                               {"--as-is"}, {"--json", true}, {"--max-vertices", true}, {"--max-bytes", true},
                               {"--quiet"}};
  known.insert(known.end(), own.begin(), own.end());
  tpa_config_init(&call.config, sizeof call.config);
  if (Status s = parse_arguments(count, words, known, call.arguments); !s) return s;
  if (Status s = expect_positionals(call.arguments, 1, 1, "one MESH"); !s) return s;
  call.path = call.arguments.positionals[0];
  if (Status s = read_clean_options(call); !s) return s;
  if (Status s = read_bounds(call.arguments, call.bounds); !s) return s;
  if (Status s = read_outputs(call.arguments, call.outputs); !s) return s;
  return read_view(call.arguments, call.outputs, call.view);
}

Status load(MeshCall& call) {
  PolygonMesh polygons;
  if (Status s = read_polygons(call.path, polygons); !s) return s;
  if (Status s = clean(call.path, std::move(polygons), call.clean, call.read); !s) return s;
  if (call.mesh().triangles.empty()) return failure(call.path, ": holds no triangle");
  if (Status s = check_as_is(call); !s) return s;
  if (call.turns_all) turn_round(call.read.mesh);
  if (call.is_open() && !call.takes_open) return failure(call.path, ": ", line_of_holes(call.read));
  if (!call.is_open()) {
    call.inside_out = find_inside_out(call.mesh());
    if (call.turns_parts && !call.inside_out.turned.empty()) {
      call.parts_turned = turn_parts(call.read.mesh, call.inside_out);
      call.inside_out = find_inside_out(call.mesh());
    }
    if (Status s = start(call); !s) return s;
  }
  for (const std::string& line : lines_of(call.read.cleaning)) note(call.outputs, text_of(call.path, ": ", line));
  if (call.is_open()) note(call.outputs, text_of(call.path, ": ", line_of_holes(call.read)));
  note_inside_out(call);
  return success();
}

void describe_reading(JsonWriter& json, const MeshCall& call) {
  describe(json, call.read.cleaning);
  describe_holes(json, call.read);
  json.member("turned_components", call.parts_turned);
  json.key("inside_out").begin_array();
  for (const TurnedPart& t : call.inside_out.turned) {
    json.begin_object().member("component", t.component).key("box").begin_array();
    for (const auto& end : {t.part.low, t.part.high})
      json.begin_array().value(end[0]).value(end[1]).value(end[2]).end_array();
    json.end_array().member("volume", t.part.volume).end_object();
  }
  json.end_array();
}

void describe_options(JsonWriter& json, const MeshCall& call) {
  json.member("mesh", call.path).member("turn", call.turns_all).member("turn_parts", call.turns_parts);
  json.member("weld", call.clean.weld).member("fill", call.clean.fill).member("as_is", call.as_is);
}

std::string line_of_all_turned(const MeshCall& call) {
  double volume = 0;
  is_inside_out(call.mesh(), volume);
  return text_of(call.path, ": the mesh is inside out", call.turns_all ? " once turned" : "", ", its signed volume is ",
                 volume, call.turns_all ? "; leave out --turn" : "; --turn turns every triangle round");
}

}  // namespace tool
