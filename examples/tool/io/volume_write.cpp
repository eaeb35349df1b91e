// SPDX-License-Identifier: MIT
#include "tool/io/volume_write.h"

#include <algorithm>
#include <cstdio>

#include "tool/io/files.h"
#include "tool/io/output_file.h"
#include "tool/io/volume_source.h"

#if TOOL_HAVE_ZLIB
#include <zlib.h>
#endif
#if TOOL_HAVE_NIFTI
#include <nifti1.h>
#endif

namespace tool {

namespace {

VoxelType type_of(const std::vector<int32_t>& labels) {
  if (labels.empty()) return VoxelType::u8;
  const auto [least, most] = std::minmax_element(labels.begin(), labels.end());
  if (*least >= 0 && *most <= UINT8_MAX) return VoxelType::u8;
  return *least >= INT16_MIN && *most <= INT16_MAX ? VoxelType::i16 : VoxelType::i32;
}

std::string packed(const std::vector<int32_t>& labels, VoxelType type) {
  std::string bytes;
  bytes.reserve(labels.size() * bytes_of(type));
  for (const int32_t label : labels) {
    if (type == VoxelType::u8) append_little_endian(bytes, static_cast<uint8_t>(label));
    if (type == VoxelType::i16) append_little_endian(bytes, static_cast<int16_t>(label));
    if (type == VoxelType::i32) append_little_endian(bytes, label);
  }
  return bytes;
}

#if TOOL_HAVE_ZLIB
Status gzipped(const std::string& bytes, std::string& out) {
  z_stream stream{};
  constexpr int window_with_gzip_header = 15 + 16, memory_level = 8;
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, window_with_gzip_header, memory_level,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    return failure("zlib does not start (out of memory?)");
  size_t taken = 0;
  for (int answer = Z_OK; answer != Z_STREAM_END;) {
    const size_t piece = std::min(bytes.size() - taken, size_t{1} << 20);
    std::string in = bytes.substr(taken, piece);
    taken += piece;
    stream.next_in = reinterpret_cast<Bytef*>(in.data());
    stream.avail_in = static_cast<uInt>(piece);
    do {
      Bytef room[1 << 16];
      stream.next_out = room;
      stream.avail_out = sizeof room;
      answer = deflate(&stream, taken == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
      out.append(reinterpret_cast<const char*>(room), sizeof room - stream.avail_out);
    } while (stream.avail_out == 0);
  }
  deflateEnd(&stream);
  return success();
}
#endif

#if TOOL_HAVE_NIFTI
// Field by field at its place, least significant byte first.
Status write_nifti(const std::string& path, const Volume& grid, const std::vector<int32_t>& labels) {
  const VoxelType type = type_of(labels);
  const Affine map = grid.space == Space::lps ? turned_about_z(grid.to_world) : grid.to_world;
  const int sizes[3] = {grid.nx, grid.ny, grid.nz};
  std::string bytes;
  const auto put = [&](auto number) { append_little_endian(bytes, number); };
  const auto fill_to = [&](size_t end) { bytes.resize(end, '\0'); };
  put(int32_t{348});
  fill_to(40);
  put(int16_t{3});
  for (const int size : sizes) {
    if (size > INT16_MAX) return failure(path, ": ", size, " voxels along an axis are too many for NIfTI-1; .nrrd can");
    put(static_cast<int16_t>(size));
  }
  for (int k = 4; k < 8; ++k) put(int16_t{1});
  fill_to(70);
  put(static_cast<int16_t>(type == VoxelType::u8 ? DT_UINT8 : type == VoxelType::i16 ? DT_INT16 : DT_INT32));
  put(static_cast<int16_t>(8 * bytes_of(type)));
  fill_to(76);
  put(1.0f);
  for (size_t k = 0; k < 3; ++k) put(static_cast<float>(map.spacing(k)));
  fill_to(108);
  put(352.0f);
  put(1.0f);
  fill_to(123);
  put(static_cast<uint8_t>(NIFTI_UNITS_MM));
  fill_to(252);
  put(static_cast<int16_t>(NIFTI_XFORM_UNKNOWN));
  put(static_cast<int16_t>(NIFTI_XFORM_SCANNER_ANAT));
  fill_to(280);
  for (size_t k = 0; k < 3; ++k) {
    for (const Point& axis : map.axes) put(static_cast<float>(axis[k]));
    put(static_cast<float>(map.origin[k]));
  }
  fill_to(344);
  bytes += std::string("n+1\0\0\0\0\0", 8);
  bytes += packed(labels, type);
#if TOOL_HAVE_ZLIB
  std::string out;
  if (ends_with_ignoring_case(path, ".gz")) {
    if (Status status = gzipped(bytes, out); !status) return failure(path, ": ", status.message);
    bytes.swap(out);
  }
#endif
  return write_file(path, bytes);
}
#endif

std::string vector_of(const Point& p) {
  char text[100];
  std::snprintf(text, sizeof text, "(%.17g,%.17g,%.17g)", p[0], p[1], p[2]);
  return text;
}

Status write_nrrd(const std::string& path, const Volume& grid, const std::vector<int32_t>& labels) {
  const VoxelType type = type_of(labels);
  const char* name = type == VoxelType::u8 ? "uint8" : type == VoxelType::i16 ? "int16" : "int32";
  const Affine& map = grid.to_world;
  const std::string space = grid.space == Space::unnamed ? "space dimension: 3"
                            : grid.space == Space::ras   ? "space: right-anterior-superior"
                                                         : "space: left-posterior-superior";
  std::string bytes = text_of("NRRD0004\ntype: ", name, "\ndimension: 3\n", space, "\nsizes: ", grid.nx, ' ', grid.ny,
                              ' ', grid.nz, "\nspace directions: ", vector_of(map.axes[0]), ' ', vector_of(map.axes[1]),
                              ' ', vector_of(map.axes[2]), "\nkinds: domain domain domain\nendian: little\n");
  bytes += text_of("space origin: ", vector_of(map.origin), '\n');
#if TOOL_HAVE_ZLIB
  bytes += "encoding: gzip\n\n";
  if (Status status = gzipped(packed(labels, type), bytes); !status) return failure(path, ": ", status.message);
#else
  bytes += "encoding: raw\n\n" + packed(labels, type);
#endif
  return write_file(path, bytes);
}

}  // namespace

Status check_labels_output(const std::string& path) {
  const bool is_nifti = ends_with_ignoring_case(path, ".nii"), is_gzip = ends_with_ignoring_case(path, ".nii.gz");
  if (!is_nifti && !is_gzip && !ends_with_ignoring_case(path, ".nrrd"))
    return failure(path, ": unknown format of a mask (known: .nii .nii.gz .nrrd)");
#if !TOOL_HAVE_NIFTI
  if (is_nifti || is_gzip) return failure(path, ": is NIfTI, and this build is without niftilib");
#endif
#if !TOOL_HAVE_ZLIB
  if (is_gzip) return failure(path, ": is compressed, and this build is without zlib");
#endif
  return check_output(path);
}

Status write_labels(const std::string& path, const Volume& grid, const std::vector<int32_t>& labels) {
  if (Status status = check_labels_output(path); !status) return status;
#if TOOL_HAVE_NIFTI
  if (!ends_with_ignoring_case(path, ".nrrd")) return write_nifti(path, grid, labels);
#endif
  return write_nrrd(path, grid, labels);
}

}  // namespace tool
