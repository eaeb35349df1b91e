// SPDX-License-Identifier: MIT
// The report on a mesh, alike in all commands.
#include <cstdio>

#include "tool/commands.h"
#include "tool/io/files.h"

namespace tool {

Status read_bounds(const Arguments& arguments, SurfaceBounds& bounds) {
  if (Status s = read_unsigned(arguments, "--max-vertices", bounds.vertices); !s) return s;
  if (Status s = read_unsigned(arguments, "--max-bytes", bounds.bytes); !s) return s;
  if (bounds.vertices < 4 || bounds.vertices > uint64_t{1} << 29)
    return failure("--max-vertices must be from 4 to ", uint64_t{1} << 29);
  return success();
}

int refuse(const Status& status) {
  std::fprintf(stderr, "topoadapt: %s\n", status.message.c_str());
  return 2;
}

Status write_json(const std::string& path, const JsonWriter& json) {
  if (path.empty()) return success();
  if (path != "-") return write_file(path, json.text() + "\n");
  std::printf("%s\n", json.text().c_str());
  return success();
}

void describe_mesh(JsonWriter& json, const TriangleMesh& mesh) {
  json.member("vertices", mesh.positions.size() / 3).member("triangles", mesh.triangles.size() / 3);
  json.key("components").begin_array();
  for (const Part& p : parts_of(mesh))
    json.begin_object().member("genus", p.genus).member("volume", p.volume).member("vertices", p.vertices).end_object();
  json.end_array();
}

}  // namespace tool
