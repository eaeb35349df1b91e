// SPDX-License-Identifier: MIT
// mesh_ply: Stanford PLY, text and binary of either byte order; any element and property may stand in the
// file, only vertex x, y, z and face vertex_indices (or vertex_index) are used. Format:
// http://paulbourke.net/dataformats/ply/
#include <cstdint>

#include "tool/io/files.h"
#include "tool/io/mesh_io.h"
#include "tool/io/polygon_mesh.h"

namespace tool {

namespace {

enum class Kind { i8, u8, i16, u16, i32, u32, f32, f64 };

struct KindName {
  const char* name;
  const char* other_name;
  Kind kind;
  size_t bytes;
};

constexpr KindName kinds[] = {{"char", "int8", Kind::i8, 1},      {"uchar", "uint8", Kind::u8, 1},
                              {"short", "int16", Kind::i16, 2},   {"ushort", "uint16", Kind::u16, 2},
                              {"int", "int32", Kind::i32, 4},     {"uint", "uint32", Kind::u32, 4},
                              {"float", "float32", Kind::f32, 4}, {"double", "float64", Kind::f64, 8}};

struct Property {
  std::string name;
  bool is_list = false;
  Kind count = Kind::u8, value = Kind::f32;
};

struct Element {
  std::string name;
  int64_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { none, text, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::none;
  std::vector<Element> elements;
};

bool kind_of(std::string_view name, Kind& kind) {
  for (const KindName& known : kinds) {
    if (name != known.name && name != known.other_name) continue;
    kind = known.kind;
    return true;
  }
  return false;
}

bool is_integer(Kind kind) { return kind != Kind::f32 && kind != Kind::f64; }

Status read_property(const std::string& place, std::string_view rest, Header& header) {
  if (header.elements.empty()) return failure(place, ": a property before any element");
  Property property;
  std::string_view word;
  next_word(rest, word);
  if (word == "list") {
    property.is_list = true;
    next_word(rest, word);
    if (!kind_of(word, property.count) || !is_integer(property.count)) {
      return failure(place, ": \"", word, "\" is not an integer type");
    }
    next_word(rest, word);
  }
  if (!kind_of(word, property.value)) return failure(place, ": \"", word, "\" is not a type");
  if (!next_word(rest, word)) return failure(place, ": a property without a name");
  property.name = word;
  header.elements.back().properties.push_back(property);
  return success();
}

Status read_header_line(const std::string& place, std::string_view rest, Header& header) {
  std::string_view word, argument;
  if (!next_word(rest, word) || word == "comment" || word == "obj_info") return success();
  if (word == "property") return read_property(place, rest, header);
  next_word(rest, argument);
  if (word == "format") {
    if (argument == "ascii") header.encoding = Encoding::text;
    if (argument == "binary_little_endian") header.encoding = Encoding::little_endian;
    if (argument == "binary_big_endian") header.encoding = Encoding::big_endian;
    if (header.encoding == Encoding::none) return failure(place, ": format \"", argument, "\" is unknown");
    return success();
  }
  if (word != "element") return failure(place, ": \"", word, "\" is not part of a PLY header");
  Element element;
  element.name = argument;
  next_word(rest, argument);
  if (!parse_integer(argument, element.count) || element.count < 0) {
    return failure(place, ": \"", argument, "\" is not a number of elements");
  }
  header.elements.push_back(element);
  return success();
}

Status read_header(const std::string& path, LineReader& lines, Header& header) {
  std::string_view line;
  if (!lines.next(line) || trimmed(line) != "ply") return failure(path, ": line 1: no \"ply\" at the start");
  bool ended = false;
  while (!ended && lines.next(line)) {
    ended = trimmed(line) == "end_header";
    if (ended) break;
    const std::string place = text_of(path, ": line ", lines.number);
    if (Status status = read_header_line(place, line, header); !status) return status;
  }
  if (!ended) return failure(path, ": the header has no end_header");
  if (header.encoding == Encoding::none) return failure(path, ": the header gives no format");
  for (const Element& element : header.elements) {
    if (element.count > 0 && element.properties.empty()) {
      return failure(path, ": element ", element.name, " has no properties");
    }
  }
  return success();
}

// The values after the header, one after the other, whatever the encoding.
struct Values {
  std::string_view rest;
  Encoding encoding;

  bool next(Kind kind, double& value) {
    return encoding == Encoding::text ? next_text(value) : next_binary(kind, value);
  }

  bool next_text(double& value) {
    std::string_view word;
    return next_word(rest, word) && parse_real(word, value);
  }

  template <class T>
  bool take(double& value) {
    if (rest.size() < sizeof(T)) return false;
    value = static_cast<double>(load<T>(rest.data(), encoding == Encoding::big_endian));
    rest.remove_prefix(sizeof(T));
    return true;
  }

  bool next_binary(Kind kind, double& value) {
    switch (kind) {
      case Kind::i8: return take<int8_t>(value);
      case Kind::u8: return take<uint8_t>(value);
      case Kind::i16: return take<int16_t>(value);
      case Kind::u16: return take<uint16_t>(value);
      case Kind::i32: return take<int32_t>(value);
      case Kind::u32: return take<uint32_t>(value);
      case Kind::f32: return take<float>(value);
      case Kind::f64: return take<double>(value);
    }
    return false;
  }
};

// Every index is below 2^32 and every count is not longer than the file, so a double holds both exactly.
constexpr double largest_index = 4294967295.0;

bool as_index(double value, int64_t& index) {
  if (!(value >= -largest_index && value <= largest_index)) return false;
  index = static_cast<int64_t>(value);
  return static_cast<double>(index) == value;
}

Status read_vertex(const std::string& place, const Element& element, Values& values, PolygonMesh& mesh) {
  double position[3] = {0, 0, 0};
  for (const Property& property : element.properties) {
    double count = 1, value = 0;
    if (property.is_list && !values.next(property.count, count)) return failure(place, ": data ends or is no number");
    for (double i = 0; i < count; ++i) {
      if (!values.next(property.value, value)) return failure(place, ": data ends or is no number");
    }
    if (property.is_list || property.name.size() != 1) continue;
    const char axis = property.name[0];
    if (axis >= 'x' && axis <= 'z') position[axis - 'x'] = value;
  }
  mesh.positions.insert(mesh.positions.end(), position, position + 3);
  return success();
}

// Any element but the vertices; `corners` receives the list of a face's vertices.
Status read_lists(const std::string& place, const Element& element, Values& values, std::vector<int64_t>& corners) {
  for (const Property& property : element.properties) {
    double count = 1, value = 0;
    if (property.is_list && !values.next(property.count, count)) return failure(place, ": data ends or is no number");
    const bool wanted = property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
    for (double i = 0; i < count; ++i) {
      if (!values.next(property.value, value)) return failure(place, ": data ends or is no number");
      int64_t index = 0;
      if (wanted && !as_index(value, index)) return failure(place, ": ", value, " is not an index");
      if (wanted) corners.push_back(index);
    }
  }
  return success();
}

Status check_elements(const std::string& path, const Header& header) {
  bool vertices = false, faces = false;
  for (const Element& element : header.elements) {
    if (element.name == "vertex") {
      int axes = 0;
      for (const Property& property : element.properties) {
        axes += !property.is_list && (property.name == "x" || property.name == "y" || property.name == "z");
      }
      if (vertices || axes != 3) return failure(path, ": the header should give one vertex element with x, y and z");
      vertices = true;
    }
    if (element.name == "face") {
      int lists = 0;
      for (const Property& property : element.properties) {
        lists += property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index");
      }
      if (!vertices) return failure(path, ": faces before vertices are not read");
      if (faces || lists != 1) return failure(path, ": the header should give one face element with vertex_indices");
      faces = true;
    }
  }
  if (!vertices) return failure(path, ": the header gives no vertex element");
  if (!faces) return failure(path, ": the header gives no face element");
  return success();
}

}  // namespace

Status parse_ply(const std::string& path, std::string_view bytes, PolygonMesh& mesh) {
  LineReader lines{bytes};
  Header header;
  if (Status status = read_header(path, lines, header); !status) return status;
  if (Status status = check_elements(path, header); !status) return status;
  Values values{bytes.substr(lines.position), header.encoding};
  std::vector<int64_t> corners;
  for (const Element& element : header.elements) {
    for (int64_t i = 0; i < element.count; ++i) {
      const auto place = [&] { return text_of(path, ": ", element.name, " ", i, " of ", element.count); };
      const bool is_vertex = element.name == "vertex";
      corners.clear();
      Status status = is_vertex ? read_vertex("", element, values, mesh) : read_lists("", element, values, corners);
      if (!status) return failure(place(), status.message);
      if (element.name != "face") continue;
      status = add_polygon("", corners, mesh);
      if (!status) return failure(path, ": face ", i, status.message);
    }
  }
  return success();
}

Status format_ply(const TriangleMesh& mesh, std::string& bytes) {
  const size_t vertices = mesh.positions.size() / 3, faces = mesh.triangles.size() / 3;
  // Many readers know only signed indices.
  if (vertices > size_t{INT32_MAX}) return failure(vertices, " vertices are too many for PLY's int");
  const std::string comment =
      mesh.space == Space::unnamed ? "" : text_of("comment topoadapt ", space_mark(mesh.space), '\n');
  bytes = text_of("ply\nformat binary_little_endian 1.0\n", comment, "element vertex ", vertices,
                  "\nproperty double x\nproperty double y\nproperty double z\nelement face ", faces,
                  "\nproperty list uchar int vertex_indices\n", mesh.labels.empty() ? "" : "property int label\n",
                  "end_header\n");
  bytes.reserve(bytes.size() + vertices * 24 + faces * 13);
  for (size_t i = 0; i < vertices * 3; ++i) append_little_endian(bytes, mesh.positions[i]);
  for (size_t i = 0; i < faces * 3; ++i) {
    if (i % 3 == 0) append_little_endian(bytes, uint8_t{3});
    append_little_endian(bytes, mesh.triangles[i]);
    if (i % 3 == 2 && !mesh.labels.empty()) append_little_endian(bytes, mesh.labels[i / 3]);
  }
  return success();
}

}  // namespace tool
