// SPDX-License-Identifier: MIT
// mesh_vtp: polygons of VTK's XML files (.vtp): arrays as text, base64 or raw bytes, plain or packed by zlib, within
// their elements or appended. Format: https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html
#include <algorithm>
#include <iterator>

#include "tool/io/base64.h"
#include "tool/io/files.h"
#include "tool/io/polygon_mesh.h"
#include "tool/io/xml.h"

namespace tool {

namespace {

struct VtpFile {
  std::string path;
  XmlDocument document;
  std::string_view appended;  // behind the underscore
  bool raw = false;           // the appended bytes
  bool big_endian = false, wide = false, packed = false;
};

bool type_of_vtk(const std::string& name, VoxelType& type) {
  constexpr TypeName names[] = {{"Int8", VoxelType::i8},    {"UInt8", VoxelType::u8},   {"Int16", VoxelType::i16},
                                {"UInt16", VoxelType::u16}, {"Int32", VoxelType::i32},  {"UInt32", VoxelType::u32},
                                {"Int64", VoxelType::i64},  {"UInt64", VoxelType::u64}, {"Float32", VoxelType::f32},
                                {"Float64", VoxelType::f64}};
  for (const TypeName& known : names)
    if (name == known.name) type = known.type;
  return std::any_of(std::begin(names), std::end(names), [&](const TypeName& known) { return name == known.name; });
}

// The numbers that VTK puts before its bytes; false where they are cut off.
bool take_sizes(const VtpFile& file, size_t count, std::string_view& bytes, std::vector<uint64_t>& sizes) {
  const size_t width = file.wide ? 8 : 4;
  if (bytes.size() / width < count) return false;
  for (size_t i = 0; i < count; ++i)
    sizes.push_back(file.wide ? load<uint64_t>(bytes.data() + 8 * i, file.big_endian)
                              : load<uint32_t>(bytes.data() + 4 * i, file.big_endian));
  bytes.remove_prefix(width * count);
  return true;
}

// Packed arrays are blocks: their number, the size of a block and of the last one unpacked, and the packed sizes.
Status unpack_blocks(const VtpFile& file, const std::string& place, std::string_view bytes, std::string& data) {
  const Status cut_off = failure(place, ": is cut off");
  std::vector<uint64_t> head, sizes;
  if (!take_sizes(file, 3, bytes, head)) return cut_off;
  if (head[0] > bytes.size() || !take_sizes(file, static_cast<size_t>(head[0]), bytes, sizes)) return cut_off;
  constexpr uint64_t largest_block = uint64_t{1} << 31;
  for (size_t i = 0; i < sizes.size(); ++i) {
    const uint64_t whole = i + 1 == sizes.size() && head[2] != 0 ? head[2] : head[1];
    if (sizes[i] > bytes.size() || whole > largest_block) return cut_off;
    std::string block;
    if (Status status =
            unpack(place, bytes.substr(0, static_cast<size_t>(sizes[i])), static_cast<size_t>(whole), block);
        !status)
      return status;
    if (block.size() != whole) return cut_off;
    data += block;
    bytes.remove_prefix(static_cast<size_t>(sizes[i]));
  }
  return success();
}

Status read_bytes(const VtpFile& file, const std::string& place, const XmlElement& array, std::string& data) {
  std::string decoded;
  std::string_view bytes;
  if (array["format"] == "appended") {
    int64_t offset = 0;
    if (!parse_integer(array["offset"], offset) || offset < 0 || static_cast<uint64_t>(offset) > file.appended.size())
      return failure(place, ": offset \"", array["offset"], "\" is not in the appended data");
    bytes = file.appended.substr(static_cast<size_t>(offset));
  } else {
    bytes = array.text;
  }
  if (array["format"] != "appended" || !file.raw) {
    if (!from_base64(bytes, decoded)) return failure(place, ": is no base64");
    bytes = decoded;
  }
  if (file.packed) return unpack_blocks(file, place, bytes, data);
  std::vector<uint64_t> size;
  if (!take_sizes(file, 1, bytes, size) || size[0] > bytes.size()) return failure(place, ": is cut off");
  data = bytes.substr(0, static_cast<size_t>(size[0]));
  return success();
}

Status read_vtp_array(const VtpFile& file, const XmlElement& array, std::vector<double>& numbers) {
  const std::string place = text_of(file.path, ": ", array["Name"]);
  VoxelType type;
  if (!type_of_vtk(array["type"], type)) return failure(place, ": type \"", array["type"], "\" is not read");
  const std::string& format = array["format"];
  if (format == "ascii" || format.empty())
    return append_numbers(array.text, numbers) ? success() : failure(place, ": is no row of numbers");
  if (format != "binary" && format != "appended") return failure(place, ": format \"", format, "\" is not read");
  std::string data;
  if (Status status = read_bytes(file, place, array, data); !status) return status;
  return append_numbers(data, type, file.big_endian, numbers) ? success() : failure(place, ": is cut off");
}

// The arrays connectivity and offsets of polygons or strips.
Status read_cells(const VtpFile& file, const XmlElement& cells, std::vector<double>& corners,
                  std::vector<double>& ends) {
  for (const size_t child : cells.children) {
    const XmlElement& array = file.document[child];
    const bool is_ends = array["Name"] == "offsets";
    if (!is_ends && array["Name"] != "connectivity") continue;
    if (Status status = read_vtp_array(file, array, is_ends ? ends : corners); !status) return status;
  }
  return success();
}

Status read_piece(const VtpFile& file, const XmlElement& piece, PolygonMesh& mesh) {
  const double first = static_cast<double>(mesh.positions.size() / 3);
  const XmlElement* points = child_of(file.document, piece, "Points");
  const XmlElement* places = points != nullptr ? child_of(file.document, *points, "DataArray") : nullptr;
  if (places == nullptr) return failure(file.path, ": a piece has no Points");
  if (Status status = read_vtp_array(file, *places, mesh.positions); !status) return status;
  int64_t count = 0;
  if (!parse_integer(piece["NumberOfPoints"], count) || count < 0 ||
      static_cast<double>(mesh.positions.size()) != 3 * (first + static_cast<double>(count)))
    return failure(file.path, ": Points has not the three numbers of each point");
  std::vector<double> corners, ends, none;
  const XmlElement* strips = child_of(file.document, piece, "Strips");
  if (strips != nullptr)
    if (Status status = read_cells(file, *strips, none, ends); !status) return status;
  if (!ends.empty()) return failure(file.path, ": has strips of triangles; only polygons are read");
  const XmlElement* polygons = child_of(file.document, piece, "Polys");
  if (polygons != nullptr)
    if (Status status = read_cells(file, *polygons, corners, ends); !status) return status;
  for (double& corner : corners) corner += first;
  if (corners.empty() != ends.empty()) return failure(file.path, ": Polys has not both connectivity and offsets");
  return corners.empty() ? success() : add_polygons(file.path, corners, ends, mesh);
}

// Raw bytes are no XML: the document ends before them.
Status split_appended(std::string_view bytes, VtpFile& file) {
  const size_t at = bytes.find("<AppendedData");
  if (at == std::string_view::npos) return parse_xml(file.path, bytes, file.document);
  const size_t close = bytes.find('>', at), begin = bytes.find('_', close);
  const std::string_view tag = bytes.substr(at, close == std::string_view::npos ? 0 : close - at);
  if (begin == std::string_view::npos) return failure(file.path, ": AppendedData has no underscore");
  file.raw = tag.find("\"raw\"") != std::string_view::npos;
  file.appended = bytes.substr(begin + 1);
  if (!file.raw) file.appended = trimmed(file.appended.substr(0, file.appended.find('<')));
  return parse_xml(file.path, std::string(bytes.substr(0, at)) + "</VTKFile>", file.document);
}

}  // namespace

Status parse_vtp(const std::string& path, std::string_view bytes, PolygonMesh& mesh) {
  VtpFile file;
  file.path = path;
  if (Status status = split_appended(bytes, file); !status) return status;
  const XmlElement& root = file.document[0];
  if (root.name != "VTKFile" || root["type"] != "PolyData") return failure(path, ": is no PolyData of VTK");
  const std::string& compressor = root["compressor"];
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor")
    return failure(path, ": packed by ", compressor, "; only zlib is read");
  file.packed = !compressor.empty();
  file.big_endian = root["byte_order"] == "BigEndian";
  file.wide = root["header_type"] == "UInt64";
  const XmlElement* data = child_of(file.document, root, "PolyData");
  if (data == nullptr) return failure(path, ": has no PolyData");
  for (const size_t child : data->children)
    if (file.document[child].name == "Piece")
      if (Status status = read_piece(file, file.document[child], mesh); !status) return status;
  return success();
}

}  // namespace tool
