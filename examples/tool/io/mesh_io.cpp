// SPDX-License-Identifier: MIT
// mesh_io: picks the format by the file's name; code shared by the formats.
#include "tool/io/mesh_io.h"

#include "tool/io/files.h"
#include "tool/io/output_file.h"
#include "tool/io/polygon_mesh.h"

namespace tool {

namespace {

struct Format {
  const char* ending;
  Status (*parse)(const std::string& path, std::string_view bytes, PolygonMesh& mesh);
  Status (*format)(const TriangleMesh& mesh, std::string& bytes);
};

constexpr Format formats[] = {{".obj", parse_obj, format_obj},    {".off", parse_off, format_off},
                              {".ply", parse_ply, format_ply},    {".stl", parse_stl, format_stl},
                              {".vtp", parse_vtp, format_vtp},    {".vtk", nullptr, format_vtk},
                              {".gii", parse_gifti, format_gifti}};

const Format* format_of(const std::string& path) {
  for (const Format& format : formats) {
    if (ends_with_ignoring_case(path, format.ending)) return &format;
  }
  return nullptr;
}

Status unknown_format(const std::string& path) {
  return failure(path, ": unknown mesh format (known: .obj .off .ply .stl .vtp .gii, to write also .vtk)");
}

}  // namespace

Status read_polygons(const std::string& path, PolygonMesh& mesh) {
  mesh = PolygonMesh();
  const Format* format = format_of(path);
  if (!format) return unknown_format(path);
  if (!format->parse)
    return failure(path, ": ", format->ending, " is written, but not read (.obj .off .ply .stl .vtp .gii are)");
  std::string bytes;
  if (Status status = read_file(path, bytes); !status) return status;
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  const std::string_view text = bytes;
  // A binary file of STL may begin with any bytes.
  const bool is_marked = format->parse != parse_stl && text.substr(0, byte_order_mark.size()) == byte_order_mark;
  Status status = format->parse(path, text.substr(is_marked ? byte_order_mark.size() : 0), mesh);
  if (!status) mesh = PolygonMesh();
  return status;
}

Status read_mesh(const std::string& path, TriangleMesh& mesh) {
  mesh = TriangleMesh();
  PolygonMesh read;
  if (Status status = read_polygons(path, read); !status) return status;
  mesh = triangles_of(std::move(read));
  return success();
}

TriangleMesh triangles_of(PolygonMesh&& polygons) {
  TriangleMesh mesh;
  if (polygons.is_soup) {
    weld_equal(polygons, {});
    drop_unused_vertices(polygons);
  }
  mesh.triangles = cut_polygons(polygons);
  mesh.positions = std::move(polygons.positions);
  return mesh;
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

}  // namespace tool
