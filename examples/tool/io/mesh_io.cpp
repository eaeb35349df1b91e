// SPDX-License-Identifier: MIT
// mesh_io: picks the format by the file's name; code shared by the formats.
#include "tool/io/mesh_io.h"

#include "tool/io/files.h"
#include "tool/io/polygon.h"

namespace tool {

namespace {

struct Format {
  const char* ending;
  Status (*parse)(const std::string& path, std::string_view bytes, TriangleMesh& mesh);
  Status (*format)(const TriangleMesh& mesh, std::string& bytes);
};

constexpr Format formats[] = {{".obj", parse_obj, format_obj}, {".off", parse_off, format_off},
                              {".ply", parse_ply, format_ply}, {".stl", parse_stl, format_stl},
                              {".vtp", nullptr, format_vtp},   {".vtk", nullptr, format_vtk},
                              {".gii", nullptr, format_gifti}};

const Format* format_of(const std::string& path) {
  for (const Format& format : formats) {
    if (ends_with_ignoring_case(path, format.ending)) return &format;
  }
  return nullptr;
}

Status unknown_format(const std::string& path) {
  return failure(path, ": unknown mesh format (known: .obj .off .ply .stl, to write also .vtp .vtk .gii)");
}

}  // namespace

Status read_mesh(const std::string& path, TriangleMesh& mesh) {
  mesh = TriangleMesh();
  const Format* format = format_of(path);
  if (!format) return unknown_format(path);
  if (!format->parse) return failure(path, ": ", format->ending, " is written, but not read (.obj .off .ply .stl are)");
  std::string bytes;
  if (Status status = read_file(path, bytes); !status) return status;
  Status status = format->parse(path, bytes, mesh);
  if (!status) mesh = TriangleMesh();
  return status;
}

Status write_mesh(const std::string& path, const TriangleMesh& mesh) {
  const Format* format = format_of(path);
  if (!format) return unknown_format(path);
  std::string bytes;
  if (Status status = format->format(mesh, bytes); !status) return failure(path, ": ", status.message);
  return write_file(path, bytes);
}

Status check_mesh_output(const std::string& path) {
  return format_of(path) ? check_output(path) : unknown_format(path);
}

std::string space_mark(Space space) {
  if (space == Space::unnamed) return "";
  return space == Space::ras ? "SPACE=RAS" : "SPACE=LPS";
}

Status add_polygon(const std::string& place, const std::vector<int64_t>& corners, int64_t first_index,
                   TriangleMesh& mesh) {
  const int64_t vertices = static_cast<int64_t>(mesh.positions.size() / 3);
  if (corners.size() < 3) return failure(place, " has ", corners.size(), " corners");
  std::vector<uint32_t> polygon;
  for (const int64_t corner : corners) {
    if (!(corner >= 0 && corner < vertices && corner < int64_t{UINT32_MAX}))
      return failure(place, ": index ", corner + first_index, " is out of range for ", vertices, " vertices");
    const auto vertex = static_cast<uint32_t>(corner);
    if (corners.size() == 3 || polygon.empty() || polygon.back() != vertex) polygon.push_back(vertex);
  }
  while (polygon.size() > 3 && polygon.front() == polygon.back()) polygon.pop_back();
  if (polygon.size() < 3) return failure(place, " has ", polygon.size(), " different corners");
  std::vector<double> positions;
  for (const uint32_t vertex : polygon) {
    const double* p = mesh.positions.data() + 3 * size_t{vertex};
    positions.insert(positions.end(), p, p + 3);
  }
  const size_t first = mesh.triangles.size();
  triangulate(positions, mesh.triangles);
  for (size_t i = first; i < mesh.triangles.size(); ++i) mesh.triangles[i] = polygon[mesh.triangles[i]];
  return success();
}

}  // namespace tool
