// SPDX-License-Identifier: MIT
// topoadapt handles
#include <cstdio>

#include "tool/commands.h"

namespace tool {

namespace {

// One handle a line, faces with vertices numbered from 1, as printed in the paper (section 4.2).
void print_handle(const uint32_t* faces, uint32_t count) {
  for (uint32_t f = 0; f < count; ++f)
    std::printf("%s(%u,%u,%u)", f == 0 ? "" : " ", faces[3 * f] + 1, faces[3 * f + 1] + 1, faces[3 * f + 2] + 1);
  std::printf("\n");
}

}  // namespace

int run_handles(int count, const char* const* words) {
  Arguments a;
  if (Status s = parse_arguments(count, words, {{"--list"}, {"--json", true}, {"--quiet"}}, a); !s) return refuse(s);
  if (Status s = expect_positionals(a, 2, TPA_HANDLE_MAX_POLYGONS, "two to four numbers of sides"); !s)
    return refuse(s);
  Outputs outputs;
  if (Status s = read_outputs(a, outputs); !s) return refuse(s);
  if (a.has("--list") && outputs.json == "-")
    return refuse(failure("--list and --json - both write to standard output"));
  uint32_t sides[TPA_HANDLE_MAX_POLYGONS] = {};
  const auto k = static_cast<uint32_t>(a.positionals.size());
  for (uint32_t i = 0; i < k; ++i) {
    uint64_t value = 0;
    if (Status s = parse_whole(a.positionals[i], "number of sides", TPA_HANDLE_MIN_SIDES, value); !s) return refuse(s);
    if (value > TPA_HANDLE_MAX_SIDES)
      return refuse(failure("the database has polygons of up to ", TPA_HANDLE_MAX_SIDES, " sides, not ", value));
    sides[i] = static_cast<uint32_t>(value);
  }
  tpa_handle_info info{};
  info.struct_size = sizeof info;
  if (tpa_handle_describe(k, sides, &info) != TPA_OK)
    return refuse(failure("the database has no handles for the numbers of sides given"));
  if (a.has("--list"))
    for (uint64_t i = 0; i < info.handles; ++i) {
      uint32_t faces[3 * TPA_HANDLE_MAX_FACES];
      if (tpa_handle_get(k, sides, i, faces, 3 * TPA_HANDLE_MAX_FACES) == TPA_OK) print_handle(faces, info.faces);
    }
  else if (outputs.summary_wanted())
    std::printf("%llu handles from %u generator%s, %u faces each%s\n", static_cast<unsigned long long>(info.handles),
                info.generators, info.generators == 1 ? "" : "s", info.faces,
                info.complete != 0 ? "" : "; a choice of the most even ones");
  JsonWriter json;
  begin_report(json);
  json.member("k", k).key("sides").begin_array();
  for (uint32_t i = 0; i < k; ++i) json.value(sides[i]);
  json.end_array().member("handles", info.handles).member("generators", info.generators).member("faces", info.faces);
  json.member("complete", info.complete != 0);
  json.key("options").begin_object().member("list", a.has("--list")).member("json", outputs.json);
  json.member("quiet", outputs.quiet).end_object().end_object();
  if (Status s = write_json(outputs.json, json); !s) return refuse(s);
  return 0;
}

}  // namespace tool
