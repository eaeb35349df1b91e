// SPDX-License-Identifier: MIT
// mesh_gifti: GIfTI surfaces (.gii) of the tools of neuroimaging: points, written as floats in RAS, and triangles.
// Format: https://www.nitrc.org/projects/gifti
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "tool/io/base64.h"
#include "tool/io/files.h"
#include "tool/io/mesh_io.h"
#include "tool/io/polygon_mesh.h"
#include "tool/io/xml.h"

namespace tool {

namespace {

std::string array_of(const char* intent, const char* type, size_t rows, const std::string& more,
                     const std::string& bytes) {
  return text_of("<DataArray Intent=\"", intent, "\" DataType=\"", type,
                 "\" ArrayIndexingOrder=\"RowMajorOrder\" Dimensionality=\"2\" Dim0=\"", rows,
                 "\" Dim1=\"3\" Encoding=\"Base64Binary\" Endian=\"LittleEndian\" ExternalFileName=\"\" "
                 "ExternalFileOffset=\"\">\n<MetaData/>\n",
                 more, "<Data>", base64(bytes), "</Data>\n</DataArray>\n");
}

constexpr const char* identity =
    "<CoordinateSystemTransformMatrix>\n<DataSpace><![CDATA[NIFTI_XFORM_SCANNER_ANAT]]></DataSpace>\n"
    "<TransformedSpace><![CDATA[NIFTI_XFORM_SCANNER_ANAT]]></TransformedSpace>\n"
    "<MatrixData>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</MatrixData>\n</CoordinateSystemTransformMatrix>\n";

}  // namespace

Status format_gifti(const TriangleMesh& mesh, std::string& bytes) {
  const size_t vertices = mesh.positions.size() / 3, triangles = mesh.triangles.size() / 3;
  if (vertices > size_t{INT32_MAX}) return failure(vertices, " vertices are too many for GIfTI's int32");
  // A half turn about z takes LPS to RAS, and keeps outside outside.
  const bool turn = mesh.space == Space::lps;
  constexpr double largest = std::numeric_limits<float>::max();
  std::string points, corners;
  for (size_t i = 0; i < mesh.positions.size(); ++i) {
    const double x = mesh.positions[i];
    if (!(std::fabs(x) <= largest)) return failure("vertex ", i / 3, " does not fit GIfTI's floats");
    append_little_endian(points, static_cast<float>(turn && i % 3 < 2 ? 0 - x : x));
  }
  for (const uint32_t corner : mesh.triangles) append_little_endian(corners, static_cast<int32_t>(corner));
  bytes = text_of(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<!DOCTYPE GIFTI SYSTEM \"http://www.nitrc.org/frs/download.php/115/gifti.dtd\">\n"
      "<GIFTI Version=\"1.0\" NumberOfDataArrays=\"2\">\n<MetaData/>\n<LabelTable/>\n",
      array_of("NIFTI_INTENT_POINTSET", "NIFTI_TYPE_FLOAT32", vertices, identity, points),
      array_of("NIFTI_INTENT_TRIANGLE", "NIFTI_TYPE_INT32", triangles, "", corners), "</GIFTI>\n");
  return success();
}

namespace {

// The codes of NIfTI.
bool type_of_array(const std::string& name, VoxelType& type) {
  constexpr TypeName names[] = {{"NIFTI_TYPE_UINT8", VoxelType::u8},    {"NIFTI_TYPE_INT32", VoxelType::i32},
                                {"NIFTI_TYPE_FLOAT32", VoxelType::f32}, {"NIFTI_TYPE_FLOAT64", VoxelType::f64},
                                {"NIFTI_TYPE_INT64", VoxelType::i64},   {"NIFTI_TYPE_UINT32", VoxelType::u32}};
  for (const TypeName& known : names)
    if (name == known.name) type = known.type;
  return std::any_of(std::begin(names), std::end(names), [&](const TypeName& known) { return name == known.name; });
}

// The numbers of an array of three columns, row by row.
Status read_gifti_array(const std::string& path, const XmlDocument& document, const XmlElement& array,
                        std::vector<double>& numbers) {
  const std::string place = text_of(path, ": ", array["Intent"]);
  VoxelType type;
  int64_t rows = 0;
  if (!type_of_array(array["DataType"], type)) return failure(place, ": DataType \"", array["DataType"], "\"");
  if (array["Dimensionality"] != "2" || array["Dim1"] != "3" || !parse_integer(array["Dim0"], rows) || rows < 0 ||
      rows > INT32_MAX)
    return failure(place, ": dimensions are not rows of three");
  const XmlElement* data = child_of(document, array, "Data");
  if (data == nullptr) return failure(place, ": has no Data");
  const std::string& encoding = array["Encoding"];
  const size_t count = 3 * static_cast<size_t>(rows);
  std::string bytes;
  bool good = encoding == "ASCII" ? append_numbers(data->text, numbers) : from_base64(data->text, bytes);
  if (encoding == "GZipBase64Binary") {
    std::string unpacked;
    if (Status status = unpack(place, bytes, count * bytes_of(type), unpacked); !status) return status;
    bytes.swap(unpacked);
  } else if (encoding != "ASCII" && encoding != "Base64Binary") {
    return failure(place, ": encoding \"", encoding, "\" is not read");
  }
  if (encoding != "ASCII") good = good && append_numbers(bytes, type, array["Endian"] == "BigEndian", numbers);
  if (!good || numbers.size() != count)
    return failure(place, ": ", numbers.size(), " numbers, the header asks for ", count);
  if (array["ArrayIndexingOrder"] != "ColumnMajorOrder") return success();
  std::vector<double> by_rows(count);
  for (size_t i = 0; i < count; ++i) by_rows[i % (count / 3) * 3 + i / (count / 3)] = numbers[i];
  numbers.swap(by_rows);
  return success();
}

}  // namespace

Status parse_gifti(const std::string& path, std::string_view bytes, PolygonMesh& mesh) {
  XmlDocument document;
  if (Status status = parse_xml(path, bytes, document); !status) return status;
  if (document[0].name != "GIFTI") return failure(path, ": is no GIfTI file");
  std::vector<double> corners;
  int points = 0, triangles = 0;
  for (const size_t child : document[0].children) {
    const XmlElement& array = document[child];
    const bool is_points = array["Intent"] == "NIFTI_INTENT_POINTSET";
    const bool is_triangles = array["Intent"] == "NIFTI_INTENT_TRIANGLE";
    if (array.name != "DataArray" || (!is_points && !is_triangles)) continue;
    if (++(is_points ? points : triangles) > 1) return failure(path, ": has two arrays ", array["Intent"]);
    if (Status status = read_gifti_array(path, document, array, is_points ? mesh.positions : corners); !status)
      return status;
  }
  if (points + triangles < 2)
    return failure(path, ": has no ", points == 0 ? "NIFTI_INTENT_POINTSET" : "NIFTI_INTENT_TRIANGLE");
  return add_polygons(path, corners, {}, mesh);
}

}  // namespace tool
