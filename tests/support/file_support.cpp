// SPDX-License-Identifier: MIT
#include "support/file_support.h"

#include <filesystem>
#include <fstream>

#if TOOL_HAVE_ZLIB
#include <zlib.h>
#endif
#if TOOL_HAVE_BZIP2
#include <bzlib.h>
#endif

namespace tool {

namespace {

// Removes the folder of a test that has passed.
class Sweeper : public testing::EmptyTestEventListener {
 public:
  void OnTestEnd(const testing::TestInfo& test) override {
    std::error_code ignored;
    if (!folder.empty() && test.result()->Passed()) std::filesystem::remove_all(folder, ignored);
    folder.clear();
  }
  std::filesystem::path folder;
};

Sweeper& sweeper() {
  static Sweeper* const only = [] {
    auto* const made = new Sweeper;  // GoogleTest frees its listeners
    testing::UnitTest::GetInstance()->listeners().Append(made);
    return made;
  }();
  return *only;
}

}  // namespace

std::string scratch_path(const std::string& name) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) /
                                       text_of("tool_files_", testing::UnitTest::GetInstance()->random_seed(), "_",
                                               testing::UnitTest::GetInstance()->current_test_info()->name());
  sweeper().folder = folder;
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

std::string written(const std::string& name, std::string_view bytes) {
  const std::string path = scratch_path(name);
  // Many small files, which need not last.
  EXPECT_TRUE(std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size())));
  return path;
}

std::string volume_error(const std::string& name, std::string_view bytes) {
  Volume volume;
  const std::string path = written(name, bytes);
  const Status status = read_volume(path, volume);
  EXPECT_FALSE(status.ok) << name << " was accepted";
  EXPECT_TRUE(volume.values.empty());
  EXPECT_EQ(status.message.substr(0, path.size()), path);
  EXPECT_EQ(status.message.find('\n'), std::string::npos);
  return status.message.substr(std::min(path.size(), status.message.size()));
}

std::string mesh_error(const std::string& name, std::string_view bytes) {
  TriangleMesh mesh;
  const std::string path = written(name, bytes);
  const Status status = read_mesh(path, mesh);
  EXPECT_FALSE(status.ok) << name << " was accepted";
  EXPECT_TRUE(mesh.positions.empty() && mesh.triangles.empty());
  EXPECT_EQ(status.message.substr(0, path.size()), path);
  return status.message.substr(std::min(path.size(), status.message.size()));
}

Volume volume_of(const std::string& path) {
  Volume volume;
  const Status status = read_volume(path, volume);
  EXPECT_TRUE(status.ok) << status.message;
  return volume;
}

TriangleMesh mesh_of(const std::string& name, std::string_view bytes) {
  TriangleMesh mesh;
  const Status status = read_mesh(written(name, bytes), mesh);
  EXPECT_TRUE(status.ok) << status.message;
  return mesh;
}

std::string nrrd(const std::string& type, const std::string& more, const std::string& sizes) {
  return "NRRD0004\n# comment\ntype: " + type + "\ndimension: 3\nsizes: " + sizes + "\n" + more + "\n";
}

std::string meta(const std::string& type, const std::string& more, const std::string& sizes) {
  return "ObjectType = Image\nNDims = 3\nDimSize = " + sizes + "\nElementType = " + type + "\n" + more;
}

// sizeof_hdr, dim, datatype, bitpix, pixdim, vox_offset, scl_slope, scl_inter, magic at their places.
std::string nifti_header(bool big, std::array<int16_t, 8> dim, int16_t type, float slope, float intercept) {
  std::string header(352, '\0');
  const auto put = [&](size_t at, const std::string& bytes) { header.replace(at, bytes.size(), bytes); };
  put(0, bytes_of_numbers<int32_t>({348}, big));
  for (size_t i = 0; i < 8; ++i) put(40 + 2 * i, bytes_of_numbers<int16_t>({static_cast<double>(dim[i])}, big));
  put(70, bytes_of_numbers<int16_t>({static_cast<double>(type)}, big));
  put(76, bytes_of_numbers<float>({1, 1, 2, 0.5}, big));
  put(108, bytes_of_numbers<float>({352, slope, intercept}, big));
  put(344, std::string("n+1\0", 4));
  return header;
}

std::string nifti2_header(bool big, std::array<int16_t, 8> dim, int16_t type) {
  std::string header(544, '\0');
  const auto put = [&](size_t at, const std::string& bytes) { header.replace(at, bytes.size(), bytes); };
  put(0, bytes_of_numbers<int32_t>({540}, big));
  put(4, std::string("n+2\0\r\n\032\n", 8));
  put(12, bytes_of_numbers<int16_t>({static_cast<double>(type)}, big));
  for (size_t i = 0; i < 8; ++i) put(16 + 8 * i, bytes_of_numbers<int64_t>({static_cast<double>(dim[i])}, big));
  put(104, bytes_of_numbers<double>({1, 1, 2, 0.5}, big));
  put(168, bytes_of_numbers<int64_t>({544}, big));
  return header;
}

#if TOOL_HAVE_ZLIB
std::string deflated(const std::string& bytes, int window_bits) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, window_bits, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())) + 64, '\0');
  std::string copy = bytes;
  stream.next_in = reinterpret_cast<Bytef*>(copy.data());
  stream.avail_in = static_cast<uInt>(copy.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = static_cast<uInt>(packed.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}
#endif

#if TOOL_HAVE_BZIP2
std::string bzipped(const std::string& bytes) {
  std::string packed(bytes.size() + bytes.size() / 100 + 700, '\0'), copy = bytes;
  auto size = static_cast<unsigned>(packed.size());
  EXPECT_EQ(BZ2_bzBuffToBuffCompress(packed.data(), &size, copy.data(), static_cast<unsigned>(copy.size()), 1, 0, 0),
            BZ_OK);
  packed.resize(size);
  return packed;
}
#endif

TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.positions = {0, 0, 0, 0, 1.5, 0, 1, 0.25, 0, 0.125, 0.5, 2};
  mesh.triangles = {0, 1, 2, 0, 2, 3, 2, 1, 3, 1, 0, 3};
  return mesh;
}

std::string real_file(const char* name) {
  const std::string path = std::string(TOPOADAPT_SHARED_DATA) + "/" + name;
  return std::filesystem::exists(path) ? path : std::string();
}

}  // namespace tool
