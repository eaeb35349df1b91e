// SPDX-License-Identifier: MIT
// mesh_off: Geomview OFF as text, with or without the vertex attributes that COFF, NOFF and STOFF add (passed
// over). Format: http://www.geomview.org/docs/html/OFF.html
#include <cstdio>

#include "tool/io/files.h"
#include "tool/io/mesh_io.h"
#include "tool/io/polygon_mesh.h"

namespace tool {

namespace {

// The next line with content, without its comment.
bool next_content(LineReader& lines, std::string_view& line) {
  while (lines.next(line)) {
    line = trimmed(line.substr(0, line.find('#')));
    if (!line.empty()) return true;
  }
  return false;
}

struct Counts {
  int64_t vertices = 0, faces = 0;
};

// "OFF", then the numbers of vertices, faces and edges, on the same line or the next. ModelNet's files have no blank
// between.
Status read_counts(const std::string& path, LineReader& lines, Counts& counts) {
  std::string_view rest, word;
  if (!next_content(lines, rest) || !next_word(rest, word)) return failure(path, ": is empty");
  if (word.size() > 3 && word.substr(0, 3) == "OFF" && word[3] >= '0' && word[3] <= '9') {
    rest = std::string_view(word.data() + 3, static_cast<size_t>(rest.data() + rest.size() - word.data()) - 3);
    word = word.substr(0, 3);
  }
  if (!ends_with_ignoring_case(word, "off")) return failure(path, ": line ", lines.number, ": no \"OFF\" at the start");
  if (word.find_first_of("4n") != std::string_view::npos) {
    return failure(path, ": line ", lines.number, ": ", word, " is not three-dimensional");
  }
  std::string_view vertices, faces;
  if (!next_word(rest, vertices)) {
    if (!next_content(lines, rest)) return failure(path, ": no numbers of vertices and faces");
    next_word(rest, vertices);
  }
  if (vertices == "BINARY") return failure(path, ": line ", lines.number, ": binary OFF is not read");
  next_word(rest, faces);
  if (!parse_integer(vertices, counts.vertices) || !parse_integer(faces, counts.faces) || counts.vertices < 0 ||
      counts.faces < 0) {
    return failure(path, ": line ", lines.number, ": \"", vertices, " ", faces,
                   "\" are not the numbers of vertices and faces");
  }
  return success();
}

Status read_vertex(const std::string& place, std::string_view rest, PolygonMesh& mesh) {
  for (int axis = 0; axis < 3; ++axis) {
    std::string_view word;
    double value = 0;
    if (!next_word(rest, word)) return failure(place, ": a vertex of ", axis, " coordinates");
    if (!parse_real(word, value)) return failure(place, ": \"", word, "\" is not a coordinate");
    mesh.positions.push_back(value);
  }
  return success();
}

// The number of corners, the corners, then perhaps a colour.
Status read_face(const std::string& place, std::string_view rest, std::vector<int64_t>& corners, PolygonMesh& mesh) {
  std::string_view word;
  int64_t count = 0;
  if (!next_word(rest, word) || !parse_integer(word, count) || count < 0) {
    return failure(place, ": \"", word, "\" is not a number of corners");
  }
  corners.clear();
  for (int64_t i = 0; i < count; ++i) {
    int64_t index = 0;
    if (!next_word(rest, word)) return failure(place, " has ", i, " of its ", count, " corners");
    if (!parse_integer(word, index)) return failure(place, ": \"", word, "\" is not an index");
    corners.push_back(index);
  }
  return add_polygon(place, corners, mesh);
}

}  // namespace

Status parse_off(const std::string& path, std::string_view text, PolygonMesh& mesh) {
  LineReader lines{text};
  Counts counts;
  if (Status status = read_counts(path, lines, counts); !status) return status;
  std::string_view line;
  for (int64_t i = 0; i < counts.vertices; ++i) {
    if (!next_content(lines, line)) return failure(path, ": ends after ", i, " of ", counts.vertices, " vertices");
    if (Status status = read_vertex(text_of(path, ": line ", lines.number), line, mesh); !status) return status;
  }
  std::vector<int64_t> corners;
  for (int64_t i = 0; i < counts.faces; ++i) {
    if (!next_content(lines, line)) return failure(path, ": ends after ", i, " of ", counts.faces, " faces");
    const std::string place = text_of(path, ": line ", lines.number, ": face ", i);
    if (Status status = read_face(place, line, corners, mesh); !status) return status;
  }
  return success();
}

Status format_off(const TriangleMesh& mesh, std::string& bytes) {
  bytes = text_of("OFF\n", mesh.positions.size() / 3, ' ', mesh.triangles.size() / 3, " 0\n");
  char line[96];
  for (size_t i = 0; i + 2 < mesh.positions.size(); i += 3) {
    const double* p = mesh.positions.data() + i;
    bytes.append(line, static_cast<size_t>(std::snprintf(line, sizeof line, "%.17g %.17g %.17g\n", p[0], p[1], p[2])));
  }
  for (size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) {
    bytes += text_of("3 ", mesh.triangles[i], ' ', mesh.triangles[i + 1], ' ', mesh.triangles[i + 2], '\n');
  }
  return success();
}

}  // namespace tool
