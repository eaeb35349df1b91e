// SPDX-License-Identifier: MIT
// file_support: files of volumes and meshes, written byte by byte, and the readers' answers.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "tool/io/files.h"
#include "tool/io/mesh_io.h"
#include "tool/io/volume.h"
#include "tool/io/volume_io.h"

namespace tool {

// A path in a folder of the running test, which is removed at the end of a test that passes.
std::string scratch_path(const std::string& name);
// Writes the bytes to a file and returns its path.
std::string written(const std::string& name, std::string_view bytes);

// The reason for refusing a file, without its path.
std::string volume_error(const std::string& name, std::string_view bytes);
std::string mesh_error(const std::string& name, std::string_view bytes);
// The content of a file expected to be accepted.
Volume volume_of(const std::string& path);
TriangleMesh mesh_of(const std::string& name, std::string_view bytes);

template <class T>
std::string bytes_of_numbers(std::initializer_list<double> numbers, bool big_endian = false) {
  std::string bytes;
  for (const double number : numbers) {
    std::string one;
    append_little_endian(one, static_cast<T>(number));
    bytes += big_endian ? std::string(one.rbegin(), one.rend()) : one;
  }
  return bytes;
}

inline const std::initializer_list<double> eight = {1, 2, 3, 4, 5, 6, 7, 100};
inline const std::vector<float> eight_values = {1, 2, 3, 4, 5, 6, 7, 100};

// Headers.
std::string nrrd(const std::string& type, const std::string& more, const std::string& sizes = "2 2 2");
std::string meta(const std::string& type, const std::string& more, const std::string& sizes = "2 2 2");
// sizeof_hdr, dim, datatype, bitpix, pixdim, vox_offset, scl_slope, scl_inter, magic at their places.
std::string nifti_header(bool big, std::array<int16_t, 8> dim, int16_t type, float slope = 0, float intercept = 0);

// The same as NIfTI-2, of 544 bytes.
std::string nifti2_header(bool big, std::array<int16_t, 8> dim, int16_t type);

#if TOOL_HAVE_ZLIB
// Window bits 15: a zlib stream, 15 + 16: gzip.
std::string deflated(const std::string& bytes, int window_bits);
#endif

#if TOOL_HAVE_BZIP2
std::string bzipped(const std::string& bytes);
#endif

// A tetrahedron with floats as coordinates, so that STL can hold them, listed in STL's order.
TriangleMesh tetrahedron();
inline const char* const text_facet =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 -0\nendloop\nendfacet\n";

// A file of TOPOADAPT_SHARED_DATA, a macro with a path in quotes; empty if absent. With TOPOADAPT_HAS_OWN_DATA files
// are those of tests/data/make_data.py.
std::string real_file(const char* name);

}  // namespace tool
