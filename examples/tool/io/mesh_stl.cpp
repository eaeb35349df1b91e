// SPDX-License-Identifier: MIT
// mesh_stl: stereolithography, text and binary. Every facet has corners of its own, which are welded later; normals are
// passed over.
// Format: http://www.fabbers.com/tech/STL_Format
#include <cmath>
#include <cstdint>
#include <limits>

#include "tool/io/files.h"
#include "tool/io/mesh_io.h"
#include "tool/io/polygon_mesh.h"

namespace tool {

namespace {

constexpr size_t title_bytes = 80, head_bytes = 84, facet_bytes = 50;

int64_t add_vertex(const double (&position)[3], PolygonMesh& mesh) {
  mesh.positions.insert(mesh.positions.end(), position, position + 3);
  return static_cast<int64_t>(mesh.positions.size() / 3) - 1;
}

Status parse_binary(const std::string& path, std::string_view bytes, PolygonMesh& mesh) {
  const uint64_t facets = load<uint32_t>(bytes.data() + title_bytes, false);
  const uint64_t needed = head_bytes + facets * facet_bytes;
  if (bytes.size() < needed) {
    return failure(path, ": ", bytes.size(), " bytes, ", facets, " binary facets need ", needed);
  }
  std::vector<int64_t> corners;
  for (uint64_t facet = 0; facet < facets; ++facet) {
    const char* corner_bytes = bytes.data() + head_bytes + facet * facet_bytes + 12;  // after the normal
    corners.clear();
    for (size_t corner = 0; corner < 3; ++corner) {
      double position[3];
      for (size_t axis = 0; axis < 3; ++axis) {
        position[axis] = static_cast<double>(load<float>(corner_bytes + 12 * corner + 4 * axis, false));
      }
      corners.push_back(add_vertex(position, mesh));
    }
    if (Status status = add_polygon(text_of(path, ": facet ", facet), corners, mesh); !status) return status;
  }
  return success();
}

Status read_corner(const std::string& place, std::string_view rest, double (&position)[3]) {
  for (double& value : position) {
    std::string_view word;
    if (!next_word(rest, word) || !parse_real(word, value))
      return failure(place, ": \"", word, "\" is not a coordinate");
  }
  return success();
}

Status parse_text(const std::string& path, std::string_view text, PolygonMesh& mesh) {
  std::vector<int64_t> corners;
  LineReader lines{text};
  std::string_view line, word;
  bool ended = false, in_loop = false;
  for (uint64_t facet = 0; lines.next(line);) {
    std::string_view rest = line;
    if (!next_word(rest, word)) continue;
    const auto place = [&] { return text_of(path, ": line ", lines.number); };
    const std::string keyword = lower_case(word);
    ended = keyword == "endsolid";
    if (keyword == "outer") {
      in_loop = true;
      corners.clear();
    } else if (keyword == "vertex") {
      double position[3];
      if (!in_loop) return failure(place(), ": a vertex outside any loop");
      if (Status status = read_corner(place(), rest, position); !status) return status;
      corners.push_back(add_vertex(position, mesh));
    } else if (keyword == "endloop") {
      in_loop = false;
      const std::string where = text_of(place(), ": facet ", facet++);
      if (Status status = add_polygon(where, corners, mesh); !status) return status;
    } else if (keyword != "solid" && keyword != "facet" && keyword != "endfacet" && !ended) {
      return failure(place(), ": \"", word.substr(0, 40), "\" is not part of text STL");
    }
  }
  return ended ? success() : failure(path, ": line ", lines.number, ": text STL ends without \"endsolid\"");
}

// Some writers begin binary files with "solid" too, so the size decides first, then bytes that text does not
// hold.
bool is_binary(std::string_view bytes) {
  if (bytes.size() >= head_bytes) {
    const uint64_t facets = load<uint32_t>(bytes.data() + title_bytes, false);
    if (bytes.size() == head_bytes + facets * facet_bytes) return true;
  }
  std::string_view text = bytes, word;
  const bool says_text = next_word(text, word) && lower_case(word.substr(0, 5)) == "solid";
  return !says_text || bytes.substr(0, 1024).find('\0') != std::string_view::npos;
}

}  // namespace

Status parse_stl(const std::string& path, std::string_view bytes, PolygonMesh& mesh) {
  mesh.is_soup = true;
  if (!is_binary(bytes)) return parse_text(path, bytes, mesh);
  if (bytes.size() < head_bytes) {
    return failure(path, ": ", bytes.size(), " bytes, neither text STL (\"solid\") nor the ", head_bytes,
                   " bytes that binary STL begins with");
  }
  return parse_binary(path, bytes, mesh);
}

Status format_stl(const TriangleMesh& mesh, std::string& bytes) {
  const size_t facets = mesh.triangles.size() / 3;
  if (facets > UINT32_MAX) return failure(facets, " triangles are too many for STL");
  constexpr double largest = std::numeric_limits<float>::max();
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    if (std::fabs(mesh.positions[i]) > largest) return failure("vertex ", i / 3, " does not fit STL's floats");
  }
  bytes = text_of("topoadapt, binary STL ", space_mark(mesh.space));
  bytes.resize(title_bytes, ' ');
  bytes.reserve(head_bytes + facets * facet_bytes);
  append_little_endian(bytes, static_cast<uint32_t>(facets));
  for (size_t facet = 0; facet < facets; ++facet) {
    const double* p[3];
    for (size_t i = 0; i < 3; ++i) p[i] = mesh.positions.data() + 3 * size_t{mesh.triangles[3 * facet + i]};
    double normal[3], length = 0;
    for (size_t i = 0; i < 3; ++i) {
      const size_t j = (i + 1) % 3, k = (i + 2) % 3;
      normal[i] = (p[1][j] - p[0][j]) * (p[2][k] - p[0][k]) - (p[1][k] - p[0][k]) * (p[2][j] - p[0][j]);
      length += normal[i] * normal[i];
    }
    length = std::sqrt(length);
    for (const double part : normal) append_little_endian(bytes, length > 0 ? static_cast<float>(part / length) : 0.0f);
    for (const double* corner : p) {
      for (size_t i = 0; i < 3; ++i) append_little_endian(bytes, static_cast<float>(corner[i]));
    }
    append_little_endian(bytes, uint16_t{0});
  }
  return success();
}

}  // namespace tool
