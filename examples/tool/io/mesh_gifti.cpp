// SPDX-License-Identifier: MIT
// mesh_gifti: GIfTI surfaces (.gii) for the tools of neuroimaging: points as floats, in RAS, and triangles.
// Format: https://www.nitrc.org/projects/gifti
#include <cmath>
#include <limits>

#include "tool/io/base64.h"
#include "tool/io/files.h"
#include "tool/io/mesh_io.h"

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

}  // namespace tool
