// SPDX-License-Identifier: MIT
// What is alike in all commands: outputs, notes, and the report on a mesh.
#include <chrono>
#include <cstdio>

#include "tool/commands.h"
#include "tool/io/output_file.h"
#include "topoadapt.h"

namespace tool {

Status read_bounds(const Arguments& arguments, SurfaceBounds& bounds) {
  if (Status s = read_unsigned(arguments, "--max-vertices", bounds.vertices); !s) return s;
  if (Status s = read_unsigned(arguments, "--max-bytes", bounds.bytes); !s) return s;
  if (bounds.vertices < 4 || bounds.vertices > uint64_t{1} << 29)
    return failure("--max-vertices must be from 4 to ", uint64_t{1} << 29);
  return success();
}

Status read_outputs(const Arguments& arguments, Outputs& outputs) {
  for (Status s : {read_text(arguments, "--out", outputs.mesh), read_text(arguments, "--json", outputs.json)})
    if (!s) return s;
  outputs.quiet = arguments.has("--quiet");
  if (!outputs.mesh.empty())
    if (Status s = check_mesh_output(outputs.mesh); !s) return s;
  if (!outputs.json.empty() && outputs.json != "-")
    if (Status s = check_output(outputs.json); !s) return s;
  if (is_same_place(outputs.mesh, outputs.json)) return failure("--out and --json both write ", outputs.mesh);
  return success();
}

void note(const Outputs& outputs, const std::string& line) {
  if (!outputs.quiet) std::fprintf(stderr, "topoadapt: note: %s\n", line.c_str());
}

double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

int refuse(const Status& status) {
  std::fprintf(stderr, "topoadapt: %s\n", status.message.c_str());
  return 2;
}

Status write_json(const std::string& path, const JsonWriter& json) {
  if (path.empty()) return success();
  if (path != "-") return write_file(path, json.text() + "\n");
  const bool written = std::printf("%s\n", json.text().c_str()) >= 0 && std::fflush(stdout) == 0;
  return written ? success() : failure("standard output: writing the report failed");
}

void begin_report(JsonWriter& json) {
  const uint32_t version = tpa_version();
  json.begin_object()
      .member("version", text_of(version >> 16, ".", version >> 8 & 0xff, ".", version & 0xff))
      .member("build", tpa_build_info());
}

std::string counted(uint64_t count, const char* one) { return text_of(count, " ", one, count == 1 ? "" : "s"); }

void describe_mesh(JsonWriter& json, const TriangleMesh& mesh, bool is_closed) {
  json.member("vertices", mesh.positions.size() / 3).member("triangles", mesh.triangles.size() / 3);
  json.key("components").begin_array();
  for (const Part& p : parts_of(mesh)) {
    json.begin_object();
    is_closed ? json.member("genus", p.genus).member("volume", p.volume)
              : json.key("genus").null().key("volume").null();
    json.member("vertices", p.vertices).end_object();
  }
  json.end_array();
}

void describe(JsonWriter& json, const SurfaceBounds& bounds) {
  json.member("max_vertices", bounds.vertices);
  bounds.bytes == SIZE_MAX ? json.key("max_bytes").null() : json.member("max_bytes", bounds.bytes);
}

void describe(JsonWriter& json, const Outputs& outputs) {
  outputs.mesh.empty() ? json.key("out").null() : json.member("out", outputs.mesh);
  json.member("json", outputs.json).member("quiet", outputs.quiet);
}

void describe_memory(JsonWriter& json, const Surface& surface) {
  json.member("arena_bytes", surface.arena_bytes()).member("peak_bytes", surface.peak_bytes());
}

}  // namespace tool
