// Tests of what the command-line tool stands on: volume and mesh files, phantoms, JSON, arguments.
// Real volumes and meshes are looked for in TOPOADAPT_SHARED_DATA, a macro with a path in quotes.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <queue>
#include <random>

#include "arguments.h"
#include "files.h"
#include "json.h"
#include "mesh_io.h"
#include "phantom.h"
#include "volume.h"
#include "volume_io.h"

#if TOOL_HAVE_ZLIB
#include <zlib.h>
#endif

namespace tool {
namespace {

std::string scratch_path(const std::string& name) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) /
      text_of("tool_files_", testing::UnitTest::GetInstance()->random_seed(), "_",
              testing::UnitTest::GetInstance()->current_test_info()->name());
  std::filesystem::create_directories(folder);
  return (folder / name).string();
}

std::string written(const std::string& name, std::string_view bytes) {
  const std::string path = scratch_path(name);
  EXPECT_TRUE(write_file(path, bytes).ok);
  return path;
}

// The path is left out of the message that is compared.
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

const std::initializer_list<double> eight = {1, 2, 3, 4, 5, 6, 7, 100};
const std::vector<float> eight_values = {1, 2, 3, 4, 5, 6, 7, 100};

// Volumes ---------------------------------------------------------------------------------------------

TEST(Volume, SampleInterpolatesAndClamps) {
  Volume volume;
  volume.nx = volume.ny = volume.nz = 2;
  volume.values = {0, 1, 2, 3, 4, 5, 6, 7};
  EXPECT_EQ(volume.sample(0.5, 0.25, 0.75), 0.5 + 2 * 0.25 + 4 * 0.75);
  EXPECT_EQ(volume.sample(-3, 9, 0), 2);
  EXPECT_EQ(volume.sample(1, 1, 1), 7);
  EXPECT_EQ(volume.sample(std::nan(""), 1e300, -1e300), 2);
}

TEST(Volume, SmoothingKeepsConstantsAndSpreadsByTheGaussian) {
  Volume volume;
  volume.nx = 21, volume.ny = 23, volume.nz = 25;
  volume.values.assign(21 * 23 * 25, 5);
  ASSERT_TRUE(smooth_gaussian(volume, 1.5).ok);
  for (const float value : volume.values) ASSERT_NEAR(value, 5, 1e-5);
  volume.values.assign(volume.values.size(), 0);
  volume.values[volume.index(10, 11, 12)] = 1000;
  ASSERT_TRUE(smooth_gaussian(volume, 1).ok);
  double sum = 0, spread_x = 0, spread_z = 0;
  for (int z = 0; z < 25; ++z) {
    for (int y = 0; y < 23; ++y) {
      for (int x = 0; x < 21; ++x) {
        sum += volume.at(x, y, z);
        spread_x += double{volume.at(x, y, z)} * (x - 10) * (x - 10);
        spread_z += double{volume.at(x, y, z)} * (z - 12) * (z - 12);
      }
    }
  }
  EXPECT_NEAR(sum, 1000, 0.01);
  EXPECT_NEAR(spread_x / sum, 1, 0.01);
  EXPECT_NEAR(spread_z / sum, 1, 0.01);
  EXPECT_NEAR(volume.at(10, 11, 12), 1000 * std::pow(2 * 3.14159265, -1.5), 0.1);
  EXPECT_FALSE(smooth_gaussian(volume, -1).ok);
  EXPECT_FALSE(smooth_gaussian(volume, std::nan("")).ok);
}

TEST(VolumeFiles, MissingAndUnknown) {
  Volume volume;
  EXPECT_EQ(read_volume("/no/such.nrrd", volume).message, "/no/such.nrrd: no such file");
  EXPECT_EQ(read_volume("a.tiff", volume).message,
            "a.tiff: unknown volume format (known: .nii .nii.gz .nrrd .nhdr .mha .mhd)");
  std::filesystem::create_directories(scratch_path("folder.mha"));
  EXPECT_EQ(read_volume(scratch_path("folder.mha"), volume).message,
            scratch_path("folder.mha") + ": is not a file");
}

std::string nrrd(const std::string& type, const std::string& more, const std::string& sizes = "2 2 2") {
  return "NRRD0004\n# comment\ntype: " + type + "\ndimension: 3\nsizes: " + sizes + "\n" + more + "\n";
}

TEST(Nrrd, EveryTypeAndByteOrder) {
  const auto check = [](const std::string& type, bool big, const std::string& bytes) {
    const std::string head =
        nrrd(type, std::string("encoding: raw\nendian: ") + (big ? "big\n" : "little\n"));
    EXPECT_EQ(volume_of(written("a.nrrd", head + bytes)).values, eight_values) << type << big;
  };
  for (const bool big : {false, true}) {
    check("signed char", big, bytes_of_numbers<int8_t>(eight, big));
    check("uchar", big, bytes_of_numbers<uint8_t>(eight, big));
    check("short", big, bytes_of_numbers<int16_t>(eight, big));
    check("unsigned short", big, bytes_of_numbers<uint16_t>(eight, big));
    check("int", big, bytes_of_numbers<int32_t>(eight, big));
    check("uint32", big, bytes_of_numbers<uint32_t>(eight, big));
    check("long long", big, bytes_of_numbers<int64_t>(eight, big));
    check("uint64_t", big, bytes_of_numbers<uint64_t>(eight, big));
    check("float", big, bytes_of_numbers<float>(eight, big));
    check("double", big, bytes_of_numbers<double>(eight, big));
  }
}

TEST(Nrrd, DetachedSkipsAndSpacing) {
  const std::string voxels = bytes_of_numbers<uint8_t>(eight);
  written("v.raw", "two\nlines\nxyz" + voxels);
  const std::string skips =
      "encoding: raw\nspacings: 1 -0.5 nan\ndata file: ./v.raw\nline skip: 2\nbyte skip: 3";
  const Volume volume = volume_of(written("v.nhdr", nrrd("uchar", skips)));
  EXPECT_EQ(volume.values, eight_values);
  EXPECT_EQ(volume.spacing[0], 1);
  EXPECT_EQ(volume.spacing[1], 0.5);
  EXPECT_EQ(volume.spacing[2], 1);
  const std::string tail =
      "encoding: raw\nspace directions: (0,3,4) (0,2,0) (1,0,0)\ndatafile: v.raw\nbyteskip: -1";
  const Volume last = volume_of(written("w.nhdr", nrrd("uchar", tail)));
  EXPECT_EQ(last.values, eight_values);
  EXPECT_EQ(last.spacing[0], 5);
}

TEST(Nrrd, RefusesBadHeaders) {
  const std::string raw = "encoding: raw\n", voxels = bytes_of_numbers<uint8_t>(eight);
  EXPECT_EQ(volume_error("a.nrrd", "hello"), ": line 1: is not NRRD (no \"NRRD\" at the start)");
  EXPECT_EQ(volume_error("a.nrrd", ""), ": line 1: is not NRRD (no \"NRRD\" at the start)");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", raw, "2 0 2") + voxels), ": line 5: sizes gives 0");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", raw, "2 -4 2") + voxels), ": line 5: sizes gives -4");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", raw, "2 x 2") + voxels), ": line 5: sizes gives \"x\"");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", raw, "2 2") + voxels),
            ": line 5: sizes gives 2 numbers, 3 are needed");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", raw, "2 2 2 2") + voxels),
            ": line 5: sizes gives 2 along axis 4, one volume has 1");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", raw, "99999 99999 99999") + voxels),
            ": line 5: sizes 99999 x 99999 x 99999 give more than the limit of 2147483648 voxels");
  EXPECT_EQ(
      volume_error("a.nrrd", nrrd("uchar", raw, "4294967296 4294967296 4294967296") + voxels),
      ": line 5: sizes 4294967296 x 4294967296 x 4294967296 give more than the limit of 2147483648 voxels");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", raw, "99999999999999999999 1 1") + voxels),
            ": line 5: sizes gives \"99999999999999999999\"");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", raw, "1 1 2147483648") + voxels),
            ": line 5: sizes gives 2147483648, more than 2147483647 along one axis");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("block", raw)),
            ": line 3: type \"block\" is not a real or integer number");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", "encoding: hex\n")),
            ": line 6: encoding \"hex\" is not read (only raw and gzip are)");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("short", raw) + voxels), ": the header gives no endian");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", "")), ": the header gives no encoding");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", "nonsense\n")), ": line 6: no \"field: value\"");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", "line skip: -3\n")), ": line 6: line skip gives \"-3\"");
}

TEST(Nrrd, RefusesDataThatIsNotThere) {
  const std::string raw = "encoding: raw\nendian: little\n", voxels = bytes_of_numbers<uint8_t>(eight);
  EXPECT_EQ(volume_error("a.nrrd", nrrd("ushort", raw) + voxels),
            ": 8 bytes of voxels, the header asks for 16");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("double", raw, "1024 1024 2048") + voxels),
            ": 8 bytes of voxels, the header asks for 17179869184");
  Volume volume;
  const std::string path = written("a.nhdr", nrrd("uchar", raw + "data file: gone.raw\n"));
  EXPECT_EQ(read_volume(path, volume).message, scratch_path("gone.raw") + ": no such file");
  const std::string data = written("short.raw", "abc");
  const std::string header = written("b.nhdr", nrrd("uchar", raw + "data file: short.raw\n"));
  EXPECT_EQ(read_volume(header, volume).message, data + ": 3 bytes of voxels, " + header + " asks for 8");
  const std::string skipping = written("c.nhdr", nrrd("uchar", raw + "data file: short.raw\nbyte skip: 9\n"));
  EXPECT_EQ(read_volume(skipping, volume).message, data + ": 3 bytes, the voxels should start at byte 9");
  const std::string lines = written("d.nhdr", nrrd("uchar", raw + "data file: short.raw\nline skip: 2\n"));
  EXPECT_EQ(read_volume(lines, volume).message, data + ": 0 lines, 2 are to be skipped");
}

TEST(Nrrd, RefusesVoxelsThatAreNotFinite) {
  const std::string head = nrrd("float", "encoding: raw\nendian: little\n");
  const double infinity = HUGE_VAL;
  EXPECT_EQ(volume_error("a.nrrd", head + bytes_of_numbers<float>({1, 2, 3, 4, 5, 6, std::nan(""), 8})),
            ": voxel (0, 1, 1) is not finite");
  EXPECT_EQ(volume_error("a.nrrd", head + bytes_of_numbers<float>({1, infinity, 3, 4, 5, 6, 7, 8})),
            ": voxel (1, 0, 0) is not finite");
}

std::string meta(const std::string& type, const std::string& more, const std::string& sizes = "2 2 2") {
  return "ObjectType = Image\nNDims = 3\nDimSize = " + sizes + "\nElementType = " + type + "\n" + more;
}

TEST(MetaImage, TypesByteOrdersAndFiles) {
  const std::string local = "ElementSpacing = 1 2 0.5\nElementDataFile = LOCAL\n";
  const Volume volume =
      volume_of(written("a.mha", meta("MET_SHORT", local) + bytes_of_numbers<int16_t>(eight)));
  EXPECT_EQ(volume.values, eight_values);
  EXPECT_EQ(volume.spacing[2], 0.5);
  const std::string msb = meta("MET_DOUBLE", "ElementByteOrderMSB = True\n" + local);
  EXPECT_EQ(volume_of(written("b.mha", msb + bytes_of_numbers<double>(eight, true))).values, eight_values);
  const std::string four_sizes =
      "NDims = 4\nDimSize = 2 2 2 1\nElementType = MET_ULONG\nElementDataFile = LOCAL\n";
  EXPECT_EQ(volume_of(written("c.mha", four_sizes + bytes_of_numbers<uint32_t>(eight))).values, eight_values);
  written("d.raw", "some head" + bytes_of_numbers<uint8_t>(eight));
  const std::string beside_it = meta("MET_UCHAR", "HeaderSize = -1\nElementDataFile = d.raw\n");
  EXPECT_EQ(volume_of(written("d.mhd", beside_it)).values, eight_values);
  const std::string after_head = meta("MET_UCHAR", "HeaderSize = 9\r\nElementDataFile = d.raw\r\n");
  EXPECT_EQ(volume_of(written("e.mhd", after_head)).values, eight_values);
}

TEST(MetaImage, RefusesBadHeadersAndData) {
  const std::string local = "ElementDataFile = LOCAL\n", voxels = bytes_of_numbers<uint8_t>(eight);
  EXPECT_EQ(volume_error("a.mha", "junk"), ": line 1: no \"Field = value\"");
  EXPECT_EQ(volume_error("a.mha", ""), ": the header gives no ElementType");
  EXPECT_EQ(volume_error("a.mha", meta("MET_UCHAR", "")), ": the header gives no ElementDataFile");
  EXPECT_EQ(volume_error("a.mha", meta("MET_UCHAR", local, "2 0 2") + voxels), ": line 3: sizes gives 0");
  EXPECT_EQ(volume_error("a.mha", meta("MET_UCHAR", local, "2 2") + voxels),
            ": line 3: DimSize gives 2 numbers, 3 are needed");
  EXPECT_EQ(volume_error("a.mha", meta("MET_UCHAR_ARRAY", local) + voxels),
            ": line 4: ElementType \"MET_UCHAR_ARRAY\" is not a real or integer number");
  EXPECT_EQ(volume_error("a.mha", meta("MET_INT", local) + voxels),
            ": 8 bytes of voxels, the header asks for 32");
  EXPECT_EQ(volume_error("a.mha", meta("MET_INT", "ElementNumberOfChannels = 3\n" + local)),
            ": line 5: ElementNumberOfChannels gives 3, one volume has 1");
  EXPECT_EQ(volume_error("a.mhd", meta("MET_INT", "ElementDataFile = slice%03d.raw\n")),
            ": line 5: voxels spread over several data files are not read");
}

// sizeof_hdr, dim, datatype, bitpix, pixdim, vox_offset, scl_slope, scl_inter, magic at their places.
std::string nifti_header(bool big, std::array<int16_t, 8> dim, int16_t type, float slope = 0,
                         float intercept = 0) {
  std::string header(352, '\0');
  const auto put = [&](size_t at, const std::string& bytes) { header.replace(at, bytes.size(), bytes); };
  put(0, bytes_of_numbers<int32_t>({348}, big));
  for (size_t i = 0; i < 8; ++i)
    put(40 + 2 * i, bytes_of_numbers<int16_t>({static_cast<double>(dim[i])}, big));
  put(70, bytes_of_numbers<int16_t>({static_cast<double>(type)}, big));
  put(76, bytes_of_numbers<float>({1, 1, 2, 0.5}, big));
  put(108, bytes_of_numbers<float>({352, slope, intercept}, big));
  put(344, std::string("n+1\0", 4));
  return header;
}

#if TOOL_HAVE_NIFTI

TEST(Nifti, TypesByteOrdersAndScale) {
  for (const bool big : {false, true}) {
    const auto check = [&](int16_t type, const std::string& bytes) {
      const std::string header = nifti_header(big, {3, 2, 2, 2, 0, 0, 0, 0}, type);
      EXPECT_EQ(volume_of(written("a.nii", header + bytes)).values, eight_values) << type << big;
    };
    check(256, bytes_of_numbers<int8_t>(eight, big));
    check(2, bytes_of_numbers<uint8_t>(eight, big));
    check(4, bytes_of_numbers<int16_t>(eight, big));
    check(512, bytes_of_numbers<uint16_t>(eight, big));
    check(8, bytes_of_numbers<int32_t>(eight, big));
    check(768, bytes_of_numbers<uint32_t>(eight, big));
    check(1024, bytes_of_numbers<int64_t>(eight, big));
    check(1280, bytes_of_numbers<uint64_t>(eight, big));
    check(16, bytes_of_numbers<float>(eight, big));
    check(64, bytes_of_numbers<double>(eight, big));
  }
  const std::string scaled = nifti_header(false, {4, 2, 1, 1, 1, 0, 0, 0}, 4, 0.5f, -3);
  const Volume volume = volume_of(written("b.nii", scaled + bytes_of_numbers<int16_t>({10, -4})));
  EXPECT_EQ(volume.values, (std::vector<float>{2, -5}));
  EXPECT_EQ(volume.spacing[1], 2);
  EXPECT_EQ(volume.spacing[2], 0.5);
}

TEST(Nifti, RefusesBadHeadersAndData) {
  const std::string voxels = bytes_of_numbers<uint8_t>(eight);
  const auto header = [](std::array<int16_t, 8> dim, int16_t type = 2) {
    return nifti_header(false, dim, type);
  };
  EXPECT_EQ(volume_error("a.nii", "short"), ": 5 bytes, a NIfTI-1 header has 348");
  EXPECT_EQ(volume_error("a.nii", std::string(400, 'x')),
            ": sizeof_hdr is 2021161080, a NIfTI-1 header has 348");
  EXPECT_EQ(volume_error("a.nii", header({3, 2, 0, 2}) + voxels), ": dim: sizes gives 0");
  EXPECT_EQ(volume_error("a.nii", header({3, 2, -7, 2}) + voxels), ": dim: sizes gives -7");
  EXPECT_EQ(volume_error("a.nii", header({3, 32767, 32767, 32767}) + voxels),
            ": dim: sizes 32767 x 32767 x 32767 give more than the limit of 2147483648 voxels");
  EXPECT_EQ(volume_error("a.nii", header({2, 2, 2, 2}) + voxels),
            ": dim[0] gives 2 dimensions, 3 are needed");
  EXPECT_EQ(volume_error("a.nii", header({4, 2, 2, 2, 5}) + voxels), ": dim[4] is 5, one volume has 1");
  EXPECT_EQ(volume_error("a.nii", header({3, 2, 2, 2}, 32) + voxels),
            ": datatype 32 is not a real or integer number");
  EXPECT_EQ(volume_error("a.nii", header({3, 2, 2, 2}, 16) + voxels),
            ": 8 bytes of voxels, the header asks for 32");
  std::string pair = header({3, 2, 2, 2});
  pair.replace(344, 3, "ni1");
  EXPECT_EQ(volume_error("a.nii", pair + voxels), ": magic is not \"n+1\", the mark of NIfTI-1 in one file");
  const std::string floats = nifti_header(false, {3, 2, 1, 1, 0, 0, 0, 0}, 16);
  EXPECT_EQ(volume_error("a.nii", floats + bytes_of_numbers<float>({1, std::nan("")})),
            ": voxel (1, 0, 0) is not finite");
}

#else

TEST(Nifti, NamesTheMissingLibrary) {
  EXPECT_EQ(volume_error("a.nii", nifti_header(false, {3, 2, 2, 2}, 2)),
            ": is NIfTI, and this build is without niftilib");
}

#endif

#if TOOL_HAVE_ZLIB

// window bits 15: a zlib stream, 15 + 16: gzip.
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

std::string many_bytes() {
  std::string bytes;
  std::mt19937 random(7);
  for (int i = 0; i < 64 * 64 * 64; ++i) bytes += static_cast<char>(random() >> 24);
  return bytes;
}

TEST(Compressed, GzipAndZlibUnpack) {
  const std::string voxels = bytes_of_numbers<uint8_t>(eight);
  const std::string head = nrrd("uchar", "encoding: gzip\n");
  EXPECT_EQ(volume_of(written("a.nrrd", head + deflated(voxels, 31))).values, eight_values);
  const std::string two_members = deflated(voxels.substr(0, 3), 31) + deflated(voxels.substr(3), 31);
  EXPECT_EQ(volume_of(written("b.nrrd", head + two_members)).values, eight_values);
  const std::string skipping = nrrd("uchar", "encoding: gz\nbyte skip: 2\nline skip: 1\n");
  EXPECT_EQ(volume_of(written("c.nrrd", skipping + "a line\n" + deflated("xy" + voxels, 31))).values,
            eight_values);
  const std::string packed = meta("MET_UCHAR", "CompressedData = True\nElementDataFile = LOCAL\n");
  EXPECT_EQ(volume_of(written("d.mha", packed + deflated(voxels, 15))).values, eight_values);
}

TEST(Compressed, RefusesDamage) {
  const std::string head = nrrd("uchar", "encoding: gzip\n", "64 64 64"), bytes = many_bytes();
  const std::string whole = deflated(bytes, 31);
  EXPECT_EQ(volume_of(written("a.nrrd", head + whole)).values.size(), bytes.size());
  const std::string half = volume_error("a.nrrd", head + whole.substr(0, whole.size() / 2));
  EXPECT_EQ(half.substr(0, 32), ": compressed data cut off after ") << half;
  // Every voxel is there, but not the checksum.
  const std::string no_sum = volume_error("a.nrrd", head + whole.substr(0, whole.size() - 8));
  EXPECT_EQ(no_sum, ": compressed data cut off after 262144 bytes");
  std::string wrong_sum = whole;
  wrong_sum[whole.size() - 6] ^= 1;
  EXPECT_EQ(volume_error("a.nrrd", head + wrong_sum),
            ": compressed data damaged after 262144 bytes (incorrect data check)");
  EXPECT_EQ(volume_error("a.nrrd", head + "not compressed at all"),
            ": compressed data damaged after 0 bytes (incorrect header check)");
  EXPECT_EQ(volume_error("a.nrrd", head), ": compressed data cut off after 0 bytes");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", "encoding: gzip\n", "1024 1024 2047") + whole),
            ": 262144 bytes of voxels, the header asks for 2146435072");
}

#if TOOL_HAVE_NIFTI
TEST(Compressed, Nifti) {
  const std::string plain =
      nifti_header(false, {3, 2, 2, 2, 0, 0, 0, 0}, 2) + bytes_of_numbers<uint8_t>(eight);
  const std::string packed = deflated(plain, 31);
  EXPECT_EQ(volume_of(written("a.nii.gz", packed)).values, eight_values);
  const std::string cut = volume_error("a.nii.gz", packed.substr(0, packed.size() - 12));
  EXPECT_EQ(cut.substr(0, 32), ": compressed data cut off after ") << cut;
  EXPECT_EQ(volume_error("a.nii.gz", plain),
            ": compressed data damaged after 0 bytes (incorrect header check)");
}
#endif

#else

TEST(Compressed, NamesTheMissingLibrary) {
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", "encoding: gzip\n")),
            ": is compressed, and this build is without zlib");
}

#endif

// Meshes ----------------------------------------------------------------------------------------------

// A tetrahedron whose coordinates are floats, so that STL can hold them, listed as STL will list them.
TriangleMesh tetrahedron() {
  TriangleMesh mesh;
  mesh.positions = {0, 0, 0, 0, 1.5, 0, 1, 0.25, 0, 0.125, 0.5, 2};
  mesh.triangles = {0, 1, 2, 0, 2, 3, 2, 1, 3, 1, 0, 3};
  return mesh;
}

TEST(MeshFiles, RoundTripInEveryFormat) {
  for (const char* name : {"a.obj", "a.off", "a.ply", "a.STL"}) {
    TriangleMesh mesh = tetrahedron(), back;
    const bool exact = std::string_view(name) != "a.STL";
    if (exact) {
      mesh.positions[3] = 0.1;
      mesh.positions[7] = -1.0 / 3;
      mesh.positions[11] = 1e-300;
    }
    const Status written_status = write_mesh(scratch_path(name), mesh);
    ASSERT_TRUE(written_status.ok) << written_status.message;
    const Status status = read_mesh(scratch_path(name), back);
    ASSERT_TRUE(status.ok) << status.message;
    EXPECT_EQ(back.positions, mesh.positions) << name;
    EXPECT_EQ(back.triangles, mesh.triangles) << name;
  }
}

TEST(MeshFiles, MissingUnknownUnwritable) {
  TriangleMesh mesh;
  EXPECT_EQ(read_mesh("/no/such.off", mesh).message, "/no/such.off: no such file");
  EXPECT_EQ(read_mesh("a.vtk", mesh).message, "a.vtk: unknown mesh format (known: .obj .off .ply .stl)");
  EXPECT_EQ(write_mesh("a.vtk", mesh).message, "a.vtk: unknown mesh format (known: .obj .off .ply .stl)");
  EXPECT_EQ(write_mesh("/no/such/a.off", mesh).message, "/no/such/a.off: cannot be opened for writing");
  mesh = tetrahedron();
  mesh.positions[4] = 1e300;
  const std::string path = scratch_path("a.stl");
  EXPECT_EQ(write_mesh(path, mesh).message, path + ": vertex 1 does not fit STL's floats");
}

TriangleMesh mesh_of(const std::string& name, std::string_view bytes) {
  TriangleMesh mesh;
  const Status status = read_mesh(written(name, bytes), mesh);
  EXPECT_TRUE(status.ok) << status.message;
  return mesh;
}

const std::vector<uint32_t> fan = {0, 1, 2, 0, 2, 3};

TEST(Obj, CornersPolygonsAndNegativeIndices) {
  const std::string vertices =
      "# c\no thing\nv 0 0 0\nv 1 0 0 1.0\r\nvt 0 0\nv 1 1 \\\n 0\nvn 0 0 1\nv 0 1 0\n";
  EXPECT_EQ(mesh_of("a.obj", vertices + "f 1 2 3 4 # all\n").triangles, fan);
  EXPECT_EQ(mesh_of("a.obj", vertices + "f 1/1 2/1/1 3//1 4\n").triangles, fan);
  EXPECT_EQ(mesh_of("a.obj", vertices + "f -4 -3 -2 -1").triangles, fan);
  EXPECT_EQ(mesh_of("a.obj", vertices).positions, (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  EXPECT_TRUE(std::isnan(mesh_of("a.obj", "v 0 nan 0\n").positions[1]));
}

TEST(Obj, Errors) {
  const std::string vertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_EQ(mesh_error("a.obj", vertices + "f 1 2 3\nf 1 2 9\n"),
            ": line 5: face 1: index 9 is not one of the 3 vertices");
  EXPECT_EQ(mesh_error("a.obj", vertices + "f 1 0 2\n"),
            ": line 4: face 0: index 0 is not one of the 3 vertices");
  EXPECT_EQ(mesh_error("a.obj", vertices + "f 1 -4 2\n"),
            ": line 4: face 0: index -4 is not one of the 3 vertices");
  EXPECT_EQ(mesh_error("a.obj", vertices + "f 1 2\n"), ": line 4: face 0 has 2 corners");
  EXPECT_EQ(mesh_error("a.obj", vertices + "f 1 b 2\n"), ": line 4: face 0: \"b\" is not an index");
  EXPECT_EQ(mesh_error("a.obj", "v 1 2\n"), ": line 1: a vertex of 2 coordinates");
  EXPECT_EQ(mesh_error("a.obj", "v 1 2 c\n"), ": line 1: \"c\" is not a coordinate");
  EXPECT_EQ(mesh_error("a.obj", ""), ": no vertex in the file");
}

TEST(Off, HeadersAndPolygons) {
  const std::string body = "0 0 0\n1 0 0 # c\n\n1 1 0\n0 1 0\n4 0 1 2 3 255 0 0\n";
  EXPECT_EQ(mesh_of("a.off", "OFF\n4 1 0\n" + body).triangles, fan);
  EXPECT_EQ(mesh_of("a.off", "OFF 4 1 0\n" + body).triangles, fan);
  EXPECT_EQ(mesh_of("a.off", "# c\nCOFF\n# d\n4 1\n" + body).triangles, fan);
}

TEST(Off, Errors) {
  EXPECT_EQ(mesh_error("a.off", ""), ": is empty");
  EXPECT_EQ(mesh_error("a.off", "PLY\n"), ": line 1: no \"OFF\" at the start");
  EXPECT_EQ(mesh_error("a.off", "OFF BINARY\n"), ": line 1: binary OFF is not read");
  EXPECT_EQ(mesh_error("a.off", "4OFF\n"), ": line 1: 4OFF is not three-dimensional");
  EXPECT_EQ(mesh_error("a.off", "OFF\n3 x\n"), ": line 2: \"3 x\" are not the numbers of vertices and faces");
  EXPECT_EQ(mesh_error("a.off", "OFF\n9000000000000000000 1 0\n0 0 0\n"),
            ": ends after 1 of 9000000000000000000 vertices");
  EXPECT_EQ(mesh_error("a.off", "OFF\n1 2 0\n0 0 0\n3 0 0 0\n"), ": ends after 1 of 2 faces");
  EXPECT_EQ(mesh_error("a.off", "OFF\n1 1 0\n0 0 0\n3 0 1 0\n"),
            ": line 4: face 0: index 1 is not one of the 1 vertices");
  EXPECT_EQ(mesh_error("a.off", "OFF\n1 1 0\n0 0 0\n9000000000000000000 0 0 0\n"),
            ": line 4: face 0 has 3 of its 9000000000000000000 corners");
  EXPECT_EQ(mesh_error("a.off", "OFF\n1 1 0\n0 0\n"), ": line 3: a vertex of 2 coordinates");
}

std::string ply(const std::string& format, const std::string& index_type, int vertices = 4) {
  return "ply\nformat " + format + " 1.0\ncomment c\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty uchar red\nproperty float y\nproperty float z\n" +
         "element face 1\nproperty list uchar " + index_type +
         " vertex_index\nproperty uchar flag\nend_header\n";
}

std::string ply_body(bool big) {
  std::string body;
  for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
    body += bytes_of_numbers<float>({static_cast<double>(x)}, big) + "r" +
            bytes_of_numbers<float>({static_cast<double>(y), 0}, big);
  }
  return body + "\4" + bytes_of_numbers<int16_t>({0, 1, 2, 3}, big) + "!";
}

TEST(Ply, TextAndBothBinaryOrders) {
  const std::string text = "0 9 0 0\n1 9 0 0\n1 9 1 0\n0 9 1 0\n4 0 1 2 3 7\n";
  const TriangleMesh mesh = mesh_of("a.ply", ply("ascii", "int") + text);
  EXPECT_EQ(mesh.triangles, fan);
  EXPECT_EQ(mesh.positions, (std::vector<double>{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}));
  for (const bool big : {false, true}) {
    const std::string head = ply(big ? "binary_big_endian" : "binary_little_endian", "short");
    const TriangleMesh binary = mesh_of("b.ply", head + ply_body(big));
    EXPECT_EQ(binary.triangles, fan);
    EXPECT_EQ(binary.positions, mesh.positions);
  }
}

TEST(Ply, Errors) {
  EXPECT_EQ(mesh_error("a.ply", "solid"), ": line 1: no \"ply\" at the start");
  EXPECT_EQ(mesh_error("a.ply", "ply\nformat ascii 1.0\n"), ": the header has no end_header");
  EXPECT_EQ(mesh_error("a.ply", "ply\nformat octal 1.0\n"), ": line 2: format \"octal\" is unknown");
  EXPECT_EQ(mesh_error("a.ply", "ply\nformat ascii 1.0\nelement vertex -1\n"),
            ": line 3: \"-1\" is not a number of elements");
  EXPECT_EQ(mesh_error("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nend_header\n"),
            ": element vertex has no properties");
  const std::string little = "binary_little_endian";
  EXPECT_EQ(mesh_error("a.ply", ply(little, "short") + ply_body(false).substr(0, 30)),
            ": vertex 2 of 4: data ends or is no number");
  EXPECT_EQ(mesh_error("a.ply", ply(little, "short", 2000000000) + ply_body(false)),
            ": vertex 4 of 2000000000: data ends or is no number");
  std::string bad_index = ply(little, "short") + ply_body(false);
  bad_index[bad_index.size() - 3] = 50;
  EXPECT_EQ(mesh_error("a.ply", bad_index), ": face 0: index 50 is not one of the 4 vertices");
  EXPECT_EQ(mesh_error("a.ply", ply("ascii", "int", 1) + "0 0 0 0\n3 0 0 -1 0\n"),
            ": face 0: index -1 is not one of the 1 vertices");
  EXPECT_EQ(mesh_error("a.ply", ply("ascii", "float", 1) + "0 0 0 0\n3 0 0.5 0 0\n"),
            ": face 0 of 1: 0.5 is not an index");
}

const char* const text_facet =
    "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 -0\nendloop\nendfacet\n";

TEST(Stl, TextBinaryAndWelding) {
  const std::string second =
      "facet normal 0 0 1\nouter loop\nvertex 1 0 -0.0\nvertex 1 1 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const TriangleMesh text = mesh_of("a.stl", std::string(text_facet) + second + "endsolid s\n");
  EXPECT_EQ(text.positions.size(), 12u);
  EXPECT_EQ(text.triangles, (std::vector<uint32_t>{0, 1, 2, 1, 3, 2}));
  // A binary file that begins like text.
  std::string bytes;
  ASSERT_TRUE(format_stl(text, bytes).ok);
  bytes.replace(0, 6, "solid ");
  const TriangleMesh binary = mesh_of("b.stl", bytes);
  EXPECT_EQ(binary.triangles, text.triangles);
}

TEST(Stl, Errors) {
  EXPECT_EQ(mesh_error("a.stl", "abc"),
            ": 3 bytes, neither text STL (\"solid\") nor the 84 bytes that binary STL begins with");
  EXPECT_EQ(mesh_error("a.stl", ""),
            ": 0 bytes, neither text STL (\"solid\") nor the 84 bytes that binary STL begins with");
  std::string bytes;
  ASSERT_TRUE(format_stl(tetrahedron(), bytes).ok);
  EXPECT_EQ(mesh_error("a.stl", bytes.substr(0, 150)), ": 150 bytes, 4 binary facets need 284");
  bytes[83] = '\x7f';
  EXPECT_EQ(mesh_error("a.stl", bytes), ": 284 bytes, 2130706436 binary facets need 106535321884");
  EXPECT_EQ(mesh_error("a.stl", text_facet), ": line 8: text STL ends without \"endsolid\"");
  EXPECT_EQ(mesh_error("a.stl", "solid s\nouter loop\nvertex 0 0\n"), ": line 3: \"\" is not a coordinate");
  EXPECT_EQ(mesh_error("a.stl", "solid s\nouter loop\nvertex 0 0 0\nendloop\n"),
            ": line 4: facet 0 has 1 corners");
  EXPECT_EQ(mesh_error("a.stl", "solid s\nhello\n"), ": line 2: \"hello\" is not part of text STL");
}

// Every prefix of a good file, and every file with one byte changed, must be read or refused, never crash.
TEST(DamagedFiles, AreReadOrRefused) {
  std::vector<std::pair<std::string, std::string>> files;
  struct Writer {
    const char* ending;
    Status (*format)(const TriangleMesh& mesh, std::string& bytes);
  };
  for (const Writer& writer : {Writer{".obj", format_obj}, Writer{".off", format_off},
                               Writer{".ply", format_ply}, Writer{".stl", format_stl}}) {
    std::string bytes;
    ASSERT_TRUE(writer.format(tetrahedron(), bytes).ok);
    files.emplace_back(writer.ending, bytes);
  }
  files.emplace_back(".stl", std::string(text_facet) + "endsolid\n");
  files.emplace_back(".nrrd",
                     nrrd("short", "encoding: raw\nendian: big\n") + bytes_of_numbers<int16_t>(eight));
  files.emplace_back(".mha",
                     meta("MET_UCHAR", "ElementDataFile = LOCAL\n") + bytes_of_numbers<uint8_t>(eight));
  files.emplace_back(".nii", nifti_header(false, {3, 2, 2, 2}, 2) + bytes_of_numbers<uint8_t>(eight));
#if TOOL_HAVE_ZLIB
  files.emplace_back(".nii.gz", deflated(files.back().second, 31));
#endif
  std::mt19937 random(1);
  for (const auto& [ending, good] : files) {
    for (size_t trial = 0; trial < 2 * good.size(); ++trial) {
      std::string bytes = good.substr(0, trial);
      if (trial >= good.size()) bytes[trial - good.size()] = static_cast<char>(random() >> 24);
      const std::string path = written("damaged" + ending, bytes);
      Volume volume;
      TriangleMesh mesh;
      const bool is_mesh = ending == ".obj" || ending == ".off" || ending == ".ply" || ending == ".stl";
      const Status status = is_mesh ? read_mesh(path, mesh) : read_volume(path, volume);
      EXPECT_EQ(status.ok, status.message.empty()) << status.message;
    }
  }
}

// Phantoms --------------------------------------------------------------------------------------------

constexpr double pi = 3.14159265358979;

Phantom phantom_named(const char* name, uint64_t seed) {
  Phantom phantom;
  const Status status = make_phantom(name, seed, phantom);
  EXPECT_TRUE(status.ok) << status.message;
  return phantom;
}

TEST(Phantoms, UnknownName) {
  Phantom phantom;
  EXPECT_EQ(make_phantom("cube", 1, phantom).message,
            "phantom \"cube\" is unknown (known: cube-cavity genus-3 torus-nested cyst)");
}

TEST(Phantoms, SameSeedSameBitsOtherSeedOthers) {
  const Phantom a = phantom_named("genus-3", 5), b = phantom_named("genus-3", 5),
                c = phantom_named("genus-3", 6);
  EXPECT_EQ(a.volume.values, b.volume.values);
  EXPECT_NE(a.volume.values, c.volume.values);
}

// Half of the voxels on the surface count.
double inside_voxels(const Phantom& phantom) {
  double count = 0;
  for (int z = 0; z < phantom.volume.nz; ++z) {
    for (int y = 0; y < phantom.volume.ny; ++y) {
      for (int x = 0; x < phantom.volume.nx; ++x) count += 0.5 * (1 - side_of_object(phantom.shape, x, y, z));
    }
  }
  return count;
}

// Monte Carlo, with the definition of the union written out, and a fixed seed; within about 0.2 %.
double volume_of_two_tori() {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> coordinate(-41, 41);
  const int trials = 4000000;
  int hits = 0;
  for (int i = 0; i < trials; ++i) {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    hits += std::hypot(std::hypot(x, z) - 32, y) < 9 || std::hypot(std::hypot(y, z) - 32, x) < 9;
  }
  return std::pow(82, 3) * hits / trials;
}

// Voxels on planes of symmetry count a thin tube 1 % too small (the trapezoid rule's error at a round end).
TEST(Phantoms, VolumesAreThoseOfTheSolids) {
  const double cap = pi * 25 * (3 * 40 - 5) / 3;  // of the ball of radius 40, beyond a face at 35
  const double cube = std::pow(70, 3) - (4 * pi / 3 * std::pow(40, 3) - 6 * cap);
  EXPECT_NEAR(inside_voxels(phantom_named("cube-cavity", 1)) / cube, 1, 0.005);
  const double nested = 2 * pi * pi * 30 * 13 * 13 - 4 * (4 * pi / 3) * 6 * 6 * 6;
  EXPECT_NEAR(inside_voxels(phantom_named("torus-nested", 1)) / nested, 1, 0.02);
  const double rod = pi * 16 * 2 * 36;  // the ends are nearly flat
  EXPECT_NEAR(inside_voxels(phantom_named("cyst", 1)) / (4 * pi / 3 * 75 * 36 * 65 - rod), 1, 0.002);
  EXPECT_NEAR(inside_voxels(phantom_named("genus-3", 1)) / volume_of_two_tori(), 1, 0.02);
}

TEST(Phantoms, ValuesHaveTheStatedNoise) {
  for (const char* name : phantom_names) {
    const Phantom phantom = phantom_named(name, default_noise_seed);
    double sum[2] = {}, squares[2] = {}, count[2] = {};
    size_t i = 0;
    for (int z = 0; z < phantom.volume.nz; ++z) {
      for (int y = 0; y < phantom.volume.ny; ++y) {
        for (int x = 0; x < phantom.volume.nx; ++x, ++i) {
          const int side = side_of_object(phantom.shape, x, y, z);
          if (side == 0) continue;
          const double off = phantom.volume.values[i] - (side > 0 ? 255.0 : 0.0);
          sum[side > 0] += off;
          squares[side > 0] += off * off;
          count[side > 0] += 1;
        }
      }
    }
    const double bright_sigma = phantom.shape == PhantomShape::cyst ? std::hypot(20, 0.2 * 255) : 20;
    for (const int bright : {0, 1}) {
      EXPECT_NEAR(sum[bright] / count[bright], 0, 0.4) << name;
      EXPECT_NEAR(std::sqrt(squares[bright] / count[bright]), bright ? bright_sigma : 20, 0.3) << name;
    }
  }
}

TEST(Phantoms, SeedBallIsInside) {
  for (const char* name : phantom_names) {
    const Phantom phantom = phantom_named(name, 1);
    const double* s = phantom.seed;
    EXPECT_EQ(side_of_object(phantom.shape, s[0], s[1], s[2]), -1) << name;
    EXPECT_GT(distance_to_surface(phantom, s[0], s[1], s[2]), phantom.radius + 2) << name;
  }
}

// The phantoms again, as functions that vanish on the surface and change by no more than the way gone
// (Lipschitz 1).
double lipschitz_level(PhantomShape shape, double x, double y, double z) {
  const auto torus = [](double u, double v, double along, double ring, double tube) {
    return std::hypot(std::hypot(u, v) - ring, along) - tube;
  };
  switch (shape) {
    case PhantomShape::cube_cavity: {
      x -= 50, y -= 50, z -= 50;
      return std::max(std::max({std::fabs(x), std::fabs(y), std::fabs(z)}) - 35, 40 - std::hypot(x, y, z));
    }
    case PhantomShape::genus_3:
      x -= 50, y -= 50, z -= 50;
      return std::min(torus(x, z, y, 32, 9), torus(y, z, x, 32, 9));
    case PhantomShape::torus_nested: {
      x -= 50, y -= 50, z -= 50;
      double level = torus(x, y, z, 30, 13);
      for (const double a : {-30.0, 30.0}) {
        level = std::max({level, 6 - std::hypot(x - a, y, z), 6 - std::hypot(x, y - a, z)});
      }
      return level;
    }
    case PhantomShape::cyst:
      x -= 99, y -= 49, z -= 85;
      return std::max(36 * (std::hypot(x / 75, y / 36, z / 65) - 1), 4 - std::hypot(x, z));
  }
  return 0;
}

struct Cell {
  double bound, x, y, z, half;
  bool operator<(const Cell& other) const { return bound > other.bound; }
};

// Brute force: cubes are taken up in the order of their distance from the point and cut into eight while the
// surface may pass through them; the first to become small enough is where the surface is nearest.
double searched_distance(PhantomShape shape, double x, double y, double z) {
  std::priority_queue<Cell> cells;
  cells.push({0, 100, 100, 100, 256});
  while (!cells.empty()) {
    const Cell cell = cells.top();
    cells.pop();
    if (cell.half < 0.003) return std::hypot(cell.x - x, cell.y - y, cell.z - z);
    const double half = cell.half / 2;
    for (int part = 0; part < 8; ++part) {
      const double cx = cell.x + (part & 1 ? half : -half), cy = cell.y + (part & 2 ? half : -half);
      const double cz = cell.z + (part & 4 ? half : -half);
      if (std::fabs(lipschitz_level(shape, cx, cy, cz)) > 1.7320509 * half) continue;
      const double bound =
          std::hypot(std::max(std::fabs(cx - x) - half, 0.0), std::max(std::fabs(cy - y) - half, 0.0),
                     std::max(std::fabs(cz - z) - half, 0.0));
      cells.push({bound, cx, cy, cz, half});
    }
  }
  return -1;
}

TEST(Phantoms, DistanceIsThatOfBruteForce) {
  for (const char* name : phantom_names) {
    const Phantom phantom = phantom_named(name, 1);
    std::mt19937 random(11);
    std::uniform_real_distribution<double> unit(0, 1);
    const auto check = [&](double x, double y, double z) {
      EXPECT_NEAR(distance_to_surface(phantom, x, y, z), searched_distance(phantom.shape, x, y, z), 0.02)
          << name << " at " << x << " " << y << " " << z;
    };
    for (int i = 0; i < 20; ++i) {
      check(phantom.volume.nx * unit(random), phantom.volume.ny * unit(random),
            phantom.volume.nz * unit(random));
    }
    // Near a seam: points within 2 of where two primitives meet.
    for (int i = 0; i < 20; ++i) {
      const double a = 2 * pi * unit(random);
      double p[3] = {50 + 19.3649 * std::cos(a), 50 + 19.3649 * std::sin(a), 15};
      if (phantom.shape == PhantomShape::cyst)
        p[0] = 99 + 4 * std::cos(a), p[1] = 84.9, p[2] = 85 + 4 * std::sin(a);
      if (phantom.shape == PhantomShape::genus_3) {
        p[0] = p[1] = 9 * std::sin(a);
        p[2] = 50 + std::sqrt(std::pow(32 + 9 * std::cos(a), 2) - p[0] * p[0]);
        p[0] += 50, p[1] += 50;
      }
      check(p[0] + 4 * unit(random) - 2, p[1] + 4 * unit(random) - 2, p[2] + 4 * unit(random) - 2);
    }
  }
}

TEST(Phantoms, DistanceWhereNoNearestPointIsUnique) {
  const Phantom cube = phantom_named("cube-cavity", 1), tori = phantom_named("genus-3", 1);
  const Phantom nested = phantom_named("torus-nested", 1), cyst = phantom_named("cyst", 1);
  EXPECT_NEAR(distance_to_surface(cube, 50, 50, 50), 40, 0.001);
  EXPECT_NEAR(distance_to_surface(tori, 50, 50, 50), 32 - 9, 0.001);
  EXPECT_NEAR(distance_to_surface(tori, 50, 50, 82), 9, 0.001);
  EXPECT_NEAR(distance_to_surface(tori, 82, 50, 50), 9, 0.001);
  EXPECT_NEAR(distance_to_surface(tori, 50, 82, 50), 9, 0.001);
  EXPECT_NEAR(distance_to_surface(nested, 50, 50, 50), 30 - 13, 0.001);
  EXPECT_NEAR(distance_to_surface(nested, 80, 50, 50), 6, 0.001);
  EXPECT_NEAR(distance_to_surface(cyst, 99, 49, 85), 4, 0.001);
  EXPECT_NEAR(distance_to_surface(cyst, 99, 60, 85), 4, 0.001);
}

// JSON and arguments ----------------------------------------------------------------------------------

TEST(Json, ObjectsArraysNumbersStrings) {
  JsonWriter json;
  json.begin_object()
      .member("name", "a\"b\\\n")
      .member("ok", true)
      .member("count", uint64_t{18446744073709551615u});
  json.key("list")
      .begin_array()
      .value(1)
      .value(-2.5)
      .value(0.1)
      .value(1.0 / 3)
      .null()
      .value(HUGE_VAL)
      .end_array();
  json.key("empty").begin_object().end_object().key("none").begin_array().end_array();
  json.key("nested").begin_array().begin_object().member("x", 1e300).end_object().begin_object().end_object();
  json.end_array().member("text", std::string("s")).end_object();
  EXPECT_EQ(json.text(),
            "{\"name\":\"a\\\"b\\\\\\u000a\",\"ok\":true,\"count\":18446744073709551615,"
            "\"list\":[1,-2.5,0.1,0.3333333333333333,null,null],\"empty\":{},\"none\":[],"
            "\"nested\":[{\"x\":1e+300},{}],\"text\":\"s\"}");
}

Status parse(std::initializer_list<const char*> words, Arguments& arguments) {
  arguments = Arguments();
  const std::vector<const char*> list(words);
  return parse_arguments(static_cast<int>(list.size()), list.data(),
                         {{"--seed", true}, {"--sigma", true}, {"--json", true}, {"--quiet", false}},
                         arguments);
}

TEST(Arguments, OptionsFlagsPositionals) {
  Arguments arguments;
  ASSERT_TRUE(
      parse({"a.off", "--seed", "1,-2.5,3e1", "--quiet", "--json", "-", "--sigma=-4", "--", "--b"}, arguments)
          .ok);
  EXPECT_EQ(arguments.positionals, (std::vector<std::string>{"a.off", "--b"}));
  EXPECT_TRUE(arguments.has("--quiet"));
  double point[3] = {}, sigma = 1;
  ASSERT_TRUE(read_point(arguments, "--seed", point).ok);
  EXPECT_EQ(point[1], -2.5);
  EXPECT_EQ(point[2], 30);
  ASSERT_TRUE(read_real(arguments, "--sigma", sigma).ok);
  EXPECT_EQ(sigma, -4);
  std::string json;
  ASSERT_TRUE(read_text(arguments, "--json", json).ok);
  EXPECT_EQ(json, "-");
  ASSERT_TRUE(parse({}, arguments).ok);
  ASSERT_TRUE(read_real(arguments, "--sigma", sigma).ok);
  EXPECT_EQ(sigma, -4);
}

TEST(Arguments, Errors) {
  Arguments arguments;
  EXPECT_EQ(parse({"--sed", "1"}, arguments).message, "unknown option --sed");
  EXPECT_EQ(parse({"-q"}, arguments).message, "unknown option -q");
  EXPECT_EQ(parse({"--seed"}, arguments).message, "--seed needs a value");
  EXPECT_EQ(parse({"--seed", "--quiet"}, arguments).message, "--seed needs a value");
  EXPECT_EQ(parse({"--seed="}, arguments).message, "--seed needs a value");
  EXPECT_EQ(parse({"--quiet=1"}, arguments).message, "--quiet takes no value");
  EXPECT_EQ(parse({"--quiet", "--quiet"}, arguments).message, "--quiet is given twice");
  double real = 0, point[3];
  uint64_t whole = 0;
  ASSERT_TRUE(parse({"--seed", "1,2", "--sigma", "nan"}, arguments).ok);
  EXPECT_EQ(read_point(arguments, "--seed", point).message, "--seed: \"1,2\" is not three numbers x,y,z");
  EXPECT_EQ(read_real(arguments, "--sigma", real).message, "--sigma: \"nan\" is not a number");
  EXPECT_EQ(read_unsigned(arguments, "--sigma", whole).message,
            "--sigma: \"nan\" is not a whole number from 0 to 2^64 - 1");
  EXPECT_EQ(parse_whole("2", "side 1", 3, whole).message,
            "side 1: \"2\" is not a whole number of at least 3");
  ASSERT_TRUE(parse({"a", "b"}, arguments).ok);
  EXPECT_EQ(expect_positionals(arguments, 1, 1, "one MESH").message, "unexpected \"b\" (expected one MESH)");
  EXPECT_EQ(expect_positionals(arguments, 3, 9, "3 or more sides").message,
            "expected 3 or more sides, got 2");
}

// Real data -------------------------------------------------------------------------------------------

#ifdef TOPOADAPT_SHARED_DATA

std::string real_file(const char* name) {
  const std::string path = std::string(TOPOADAPT_SHARED_DATA) + "/" + name;
  return std::filesystem::exists(path) ? path : std::string();
}

TEST(RealData, Tooth) {
  const std::string path = real_file("volumes/tooth.nhdr");
  if (path.empty()) GTEST_SKIP() << "no real data in " << TOPOADAPT_SHARED_DATA;
  const Volume tooth = volume_of(path);
  EXPECT_EQ(tooth.nx, 103);
  EXPECT_EQ(tooth.ny, 94);
  EXPECT_EQ(tooth.nz, 161);
  EXPECT_EQ(tooth.at(50, 40, 80), 3 * 256 + 64);  // od -j 1557460 -N 2 -t u1 tooth.raw
}

#if TOOL_HAVE_NIFTI && TOOL_HAVE_ZLIB
TEST(RealData, Nifti) {
  const std::string path = real_file("volumes/engine.nii.gz");
  if (path.empty()) GTEST_SKIP() << "no real data in " << TOPOADAPT_SHARED_DATA;
  const Volume engine = volume_of(path);
  EXPECT_EQ(engine.nx, 256);
  EXPECT_EQ(engine.ny, 256);
  EXPECT_EQ(engine.nz, 128);
  EXPECT_EQ(engine.at(130, 120, 60), 122);  // od -j 3963362 -N 1 -t u1, unpacked
  const Volume vessels = volume_of(real_file("volumes/avf_float_32.nii.gz"));
  EXPECT_EQ(vessels.nx, 74);
  EXPECT_EQ(vessels.ny, 93);
  EXPECT_EQ(vessels.nz, 20);
  EXPECT_NEAR(vessels.at(37, 46, 10), 364.3384, 0.0001);
}
#endif

TEST(RealData, Meshes) {
  if (real_file("meshes/two_spheres.stl").empty())
    GTEST_SKIP() << "no real data in " << TOPOADAPT_SHARED_DATA;
  TriangleMesh spheres, cow, tangled;
  EXPECT_TRUE(read_mesh(real_file("meshes/two_spheres.stl"), spheres).ok);
  EXPECT_EQ(spheres.positions.size() / 3, 804u);
  EXPECT_EQ(spheres.triangles.size() / 3, 1600u);
  EXPECT_TRUE(read_mesh(real_file("meshes/cow.off"), cow).ok);
  EXPECT_EQ(cow.positions.size() / 3, 2762u);
  EXPECT_EQ(cow.triangles.size() / 3, 2u * 2762 - 4);
  EXPECT_TRUE(read_mesh(real_file("meshes/self_intersectA.obj"), tangled).ok);
  EXPECT_EQ(tangled.positions.size() / 3, 8582u);
  EXPECT_EQ(tangled.triangles.size() / 3, 2u * 8582 - 4);
}

#endif

}  // namespace
}  // namespace tool
