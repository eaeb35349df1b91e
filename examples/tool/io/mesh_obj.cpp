// SPDX-License-Identifier: MIT
// mesh_obj: Wavefront OBJ, vertices and faces only; everything else in the file is passed over.
// Format: http://paulbourke.net/dataformats/obj/
#include <cstdio>

#include "tool/io/files.h"
#include "tool/io/mesh_io.h"
#include "tool/io/polygon_mesh.h"

namespace tool {

namespace {

// A backslash at the end of a line continues the line.
bool next_whole_line(LineReader& lines, std::string& whole) {
  std::string_view line;
  if (!lines.next(line)) return false;
  whole = line;
  while (!whole.empty() && whole.back() == '\\') {
    whole.back() = ' ';
    if (!lines.next(line)) break;
    whole += line;
  }
  return true;
}

Status read_vertex(const std::string& path, uint64_t line, std::string_view rest, PolygonMesh& mesh) {
  for (int axis = 0; axis < 3; ++axis) {
    std::string_view word;
    double value = 0;
    if (!next_word(rest, word)) return failure(path, ": line ", line, ": a vertex of ", axis, " coordinates");
    if (!parse_real(word, value)) return failure(path, ": line ", line, ": \"", word, "\" is not a coordinate");
    mesh.positions.push_back(value);
  }
  return success();
}

// Corners are "v", "v/vt", "v//vn" or "v/vt/vn"; v counts from 1, or from -1 backwards from the last vertex
// so far.
Status read_face(const std::string& path, uint64_t line, uint64_t face, std::string_view rest,
                 std::vector<int64_t>& corners, PolygonMesh& mesh) {
  const int64_t vertices = static_cast<int64_t>(mesh.positions.size() / 3);
  const std::string place = text_of(path, ": line ", line, ": face ", face);
  corners.clear();
  std::string_view word;
  while (next_word(rest, word)) {
    const std::string_view digits = word.substr(0, word.find('/'));
    int64_t index = 0;
    if (!parse_integer(digits, index)) return failure(place, ": \"", word, "\" is not an index");
    const bool known = index >= -vertices && index <= vertices && index != 0;
    if (!known) return failure(place, ": index ", index, " is out of range for ", vertices, " vertices");
    corners.push_back(index > 0 ? index - 1 : vertices + index);
  }
  return add_polygon(place, corners, mesh);
}

}  // namespace

Status parse_obj(const std::string& path, std::string_view text, PolygonMesh& mesh) {
  LineReader lines{text};
  std::string line;
  std::vector<int64_t> corners;
  uint64_t faces = 0;
  mesh.first_vertex = 1;
  for (uint64_t first_line = 1; next_whole_line(lines, line); first_line = lines.number + 1) {
    std::string_view rest = std::string_view(line).substr(0, line.find('#'));
    std::string_view word;
    if (!next_word(rest, word)) continue;
    Status status;
    if (word == "v") status = read_vertex(path, first_line, rest, mesh);
    if (word == "f") status = read_face(path, first_line, faces++, rest, corners, mesh);
    if (!status) return status;
  }
  if (mesh.positions.empty()) return failure(path, ": no vertex in the file");
  return success();
}

Status format_obj(const TriangleMesh& mesh, std::string& bytes) {
  char line[96];
  if (mesh.space != Space::unnamed) bytes = text_of("# topoadapt ", space_mark(mesh.space), '\n');
  for (size_t i = 0; i + 2 < mesh.positions.size(); i += 3) {
    const double* p = mesh.positions.data() + i;
    bytes.append(line,
                 static_cast<size_t>(std::snprintf(line, sizeof line, "v %.17g %.17g %.17g\n", p[0], p[1], p[2])));
  }
  for (size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    const bool new_label = !mesh.labels.empty() && (i == 0 || mesh.labels[i / 3] != mesh.labels[i / 3 - 1]);
    if (new_label) bytes += text_of("g label_", mesh.labels[i / 3], '\n');
    bytes += text_of("f ", uint64_t{mesh.triangles[i]} + 1, ' ', uint64_t{mesh.triangles[i + 1]} + 1, ' ',
                     uint64_t{mesh.triangles[i + 2]} + 1, '\n');
  }
  return success();
}

}  // namespace tool
