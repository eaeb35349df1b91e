// SPDX-License-Identifier: MIT
// mesh_vtk: polygons for VTK, ParaView and 3D Slicer: XML (.vtp) with arrays as base64, and the legacy format (.vtk),
// binary, most significant byte first. Formats: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html
#include <algorithm>

#include "tool/io/base64.h"
#include "tool/io/files.h"
#include "tool/io/mesh_io.h"

namespace tool {

namespace {

Status check_counts(const TriangleMesh& mesh) {
  const size_t vertices = mesh.positions.size() / 3, triangles = mesh.triangles.size() / 3;
  constexpr size_t most = INT32_MAX / 4;
  return vertices <= most && triangles <= most ? success() : failure(triangles, " triangles are too many for VTK");
}

// The number of bytes comes first, apart from them.
std::string array_of(const std::string& attributes, const std::string& bytes) {
  std::string size;
  append_little_endian(size, static_cast<uint64_t>(bytes.size()));
  return text_of("<DataArray ", attributes, " format=\"binary\">", base64(size + bytes), "</DataArray>\n");
}

template <class To, class From>
std::string packed(const std::vector<From>& numbers) {
  std::string bytes;
  bytes.reserve(numbers.size() * sizeof(To));
  for (const From number : numbers) append_little_endian(bytes, static_cast<To>(number));
  return bytes;
}

// 3D Slicer looks for the space here.
std::string field_of(Space space) {
  if (space == Space::unnamed) return "";
  const char* letters = space == Space::ras ? "82 65 83 0" : "76 80 83 0";
  return text_of("<FieldData>\n<Array type=\"String\" Name=\"SPACE\" NumberOfTuples=\"1\" format=\"ascii\">", letters,
                 "</Array>\n</FieldData>\n");
}

template <class T>
void append_big_endian(std::string& bytes, T value) {
  std::string little;
  append_little_endian(little, value);
  bytes.append(little.rbegin(), little.rend());
}

}  // namespace

Status format_vtp(const TriangleMesh& mesh, std::string& bytes) {
  if (Status status = check_counts(mesh); !status) return status;
  const size_t triangles = mesh.triangles.size() / 3;
  std::string ends;
  for (size_t i = 1; i <= triangles; ++i) append_little_endian(ends, static_cast<int64_t>(3 * i));
  bytes = text_of(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<PolyData>\n",
      field_of(mesh.space), "<Piece NumberOfPoints=\"", mesh.positions.size() / 3,
      "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"", triangles, "\">\n");
  if (!mesh.labels.empty())
    bytes += "<CellData Scalars=\"label\">\n" +
             array_of("type=\"Int32\" Name=\"label\"", packed<int32_t>(mesh.labels)) + "</CellData>\n";
  bytes += "<Points>\n" +
           array_of("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", packed<double>(mesh.positions)) +
           "</Points>\n<Polys>\n" + array_of("type=\"Int64\" Name=\"connectivity\"", packed<int64_t>(mesh.triangles)) +
           array_of("type=\"Int64\" Name=\"offsets\"", ends) + "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
  return success();
}

Status format_vtk(const TriangleMesh& mesh, std::string& bytes) {
  if (Status status = check_counts(mesh); !status) return status;
  const size_t triangles = mesh.triangles.size() / 3;
  bytes = text_of("# vtk DataFile Version 3.0\ntopoadapt ", space_mark(mesh.space),
                  "\nBINARY\nDATASET POLYDATA\nPOINTS ", mesh.positions.size() / 3, " double\n");
  for (const double x : mesh.positions) append_big_endian(bytes, x);
  bytes += text_of("\nPOLYGONS ", triangles, ' ', 4 * triangles, '\n');
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (i % 3 == 0) append_big_endian(bytes, int32_t{3});
    append_big_endian(bytes, static_cast<int32_t>(mesh.triangles[i]));
  }
  if (!mesh.labels.empty()) {
    bytes += text_of("\nCELL_DATA ", triangles, "\nSCALARS label int 1\nLOOKUP_TABLE default\n");
    for (const int32_t label : mesh.labels) append_big_endian(bytes, label);
  }
  bytes += '\n';
  return success();
}

}  // namespace tool
