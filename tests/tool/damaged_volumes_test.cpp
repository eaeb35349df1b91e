// SPDX-License-Identifier: MIT
// Volume files cut off at every byte, and with changed headers: read, or refused with a line that names a file, without
// a crash and with memory for no more than a file holds. Under AddressSanitizer, larger blocks end the test.
#include <sys/resource.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <random>

#include "support/dicom_support.h"
#include "support/file_support.h"

extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "max_allocation_size_mb=400"; }

namespace tool {
namespace damaged_volumes_test {
namespace {

// As `ulimit -v 500000`: GDCM takes a second to fill as much memory as a damaged header names. Sanitizers reserve more
// addresses.
void bound_memory() {
  if (TOPOADAPT_SANITIZED) return;
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, rlim_t{500000} * 1024);
  EXPECT_EQ(setrlimit(RLIMIT_AS, &limit), 0);
}

struct Sample {
  const char* name;
  std::string bytes;
  size_t header;  // bytes of which some are changed; behind them, voxels
};

const std::string voxels = bytes_of_numbers<uint8_t>(eight);

// Files beside the samples, so that changed headers find them.
void write_companions() {
  bound_memory();
  written("v.raw", voxels);
  written("v0", voxels.substr(0, 4));
  written("v1", voxels.substr(4));
  written("p.img", voxels);
}

std::string four_axes() {
  return "NRRD0005\ntype: uchar\ndimension: 4\nspace: LPS\nsizes: 1 2 2 2\nkinds: list domain domain domain\n"
         "space directions: none (1,0,0) (0,1,0) (0,0,2)\nspace origin: (1,2,3)\nendian: little\nencoding: raw\n\n";
}

std::vector<Sample> samples() {
  std::vector<Sample> all;
  const auto add = [&](const char* name, const std::string& header, const std::string& data) {
    all.push_back({name, header + data, header.size()});
  };
  const std::string space = "space: RAS\nspace directions: (1,0,0) (0,1,0) (0,0,2)\nspace origin: (1,2,3)\n";
  add("raw.nrrd", nrrd("uchar", space + "encoding: raw\n"), voxels);
  add("list.nrrd", four_axes(), voxels);
  add("ascii.nrrd", nrrd("float", "encoding: ascii\n"), "1 2 3 4 5 6 7 100");
  add("hex.nrrd", nrrd("short", "endian: big\nencoding: hex\n"), "00010002 00030004 00050006 00070064");
  add("file.nhdr", nrrd("uchar", "units: \"mm\" \"mm\" \"um\"\nencoding: raw\nline skip: 0\ndata file: v.raw\n"), "");
  add("names.nhdr", nrrd("uchar", "encoding: raw\nbyte skip: 0\ndata file: LIST\nv0\nv1\n"), "");
  add("pattern.nhdr", nrrd("uchar", "encoding: raw\nbyte skip: -1\ndata file: v%d 0 1 1\n"), "");
  add("local.mha", meta("MET_UCHAR", "TransformMatrix = 1 0 0 0 1 0 0 0 1\nElementDataFile = LOCAL\n"), voxels);
  add("text.mha", meta("MET_SHORT", "BinaryData = False\nElementDataFile = LOCAL\n"), "1 2 3 4 5 6 7 100");
  add("names.mhd", meta("MET_UCHAR", "HeaderSize = 0\nElementDataFile = LIST\nv0\nv1\n"), "");
  add("pattern.mhd", meta("MET_UCHAR", "HeaderSize = -1\nElementDataFile = v%d 0 1 1\n"), "");
#if TOOL_HAVE_ZLIB
  add("packed.nrrd", nrrd("uchar", "encoding: gzip\n"), deflated(voxels, 31));
  add("packed.mha", meta("MET_UCHAR", "CompressedData = True\nElementDataFile = LOCAL\n"), deflated(voxels, 15));
  all.push_back({"whole.nrrd.gz", deflated(nrrd("uchar", "encoding: raw\n") + voxels, 31), SIZE_MAX});
#endif
#if TOOL_HAVE_BZIP2
  add("bzip.nrrd", nrrd("uchar", "encoding: bzip2\n"), bzipped(voxels));
#endif
#if TOOL_HAVE_NIFTI
  add("one.nii", nifti_header(false, {4, 2, 2, 2, 1, 0, 0, 0}, 2, 2, 1), voxels);
  add("two.nii", nifti2_header(true, {3, 2, 2, 2, 0, 0, 0, 0}, 2), voxels);
  std::string pair = nifti_header(true, {3, 2, 2, 2, 0, 0, 0, 0}, 2);
  pair.replace(344, 3, "ni1");
  pair.replace(108, 4, std::string(4, '\0'));
  add("p.hdr", pair.substr(0, 348), "");
#endif
  for (Sample& sample : all) sample.header = std::min(sample.header, sample.bytes.size());
  return all;
}

// Returns whether the file was read.
bool judge(const std::string& path, size_t bytes, const std::string& what) {
  Volume volume;
  const Status status = read_volume(path, {uint64_t{0}, false}, volume);
  if (!status) {
    const std::string folder = std::filesystem::path(path).parent_path().string();
    // A changed header may name a data file anywhere.
    const std::string named = status.message.substr(0, status.message.find(": "));
    EXPECT_TRUE(named.rfind(folder, 0) == 0 || std::filesystem::path(named).is_absolute()) << what << status.message;
    EXPECT_EQ(status.message.find('\n'), std::string::npos) << what << status.message;
    EXPECT_TRUE(volume.values.empty()) << what;
    return false;
  }
  EXPECT_TRUE(volume.nx > 0 && volume.ny > 0 && volume.nz > 0) << what;
  const size_t count = static_cast<size_t>(volume.nx) * static_cast<size_t>(volume.ny) * static_cast<size_t>(volume.nz);
  EXPECT_EQ(volume.values.size(), count) << what;
  constexpr size_t deflate_ratio = 1100;
  EXPECT_LE(count, deflate_ratio * (bytes + 100)) << what;
  EXPECT_TRUE(is_regular(volume.to_world)) << what;
  return true;
}

// Single bits and bytes, numbers, and lines.
std::string changed(const Sample& sample, std::mt19937& random) {
  std::string bytes = sample.bytes;
  const auto below = [&](size_t n) { return static_cast<size_t>(random()) % n; };
  static const char* const numbers[] = {"-1", "0", "99999999", "2147483648", "4294967297", "nan", "1e300", "%s", "-0"};
  for (size_t changes = 1 + below(3); changes > 0; --changes) {
    const size_t at = below(std::min(sample.header, bytes.size()));
    switch (below(6)) {
      case 0: bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8))); break;
      case 1: bytes[at] = static_cast<char>(random()); break;
      case 2: bytes.replace(at, 1, numbers[below(std::size(numbers))]); break;
      case 3: bytes.erase(at, 1 + below(8)); break;
      case 4: bytes.insert(at, bytes.substr(below(bytes.size()), 1 + below(20))); break;
      default: bytes.replace(at, std::min<size_t>(4, bytes.size() - at), std::string(4, below(2) ? '\xff' : '\x7f'));
    }
    if (bytes.empty()) bytes = "x";
  }
  return bytes;
}

void try_changed(unsigned seed, int count) {
  write_companions();
  int accepted = 0, tried = 0;
  for (const Sample& sample : samples()) {
    std::mt19937 random(seed);
    for (int i = 0; i < count; ++i, ++tried) {
      const std::string bytes = changed(sample, random);
      const std::string what =
          std::string(sample.name) + ", seed " + std::to_string(seed) + ", change " + std::to_string(i);
      accepted += judge(written(sample.name, bytes), bytes.size(), what) ? 1 : 0;
      if (testing::Test::HasFailure()) return;
    }
  }
  // Both ways out are tried.
  EXPECT_GT(accepted, tried / 20);
  EXPECT_LT(accepted, tried * 19 / 20);
}

// More of them where TOPOADAPT_CHANGES says how many.
int changes_of_long(int usual) {
  const char* const asked = std::getenv("TOPOADAPT_CHANGES");
  return asked ? std::atoi(asked) : usual;
}

TEST(DamagedVolumes, CutOffAtEveryByte) {
  write_companions();
  for (const Sample& sample : samples()) {
    EXPECT_TRUE(judge(written(sample.name, sample.bytes), sample.bytes.size(), sample.name)) << sample.name;
    for (size_t size = 0; size < sample.bytes.size() && !HasFailure(); ++size)
      judge(written(sample.name, sample.bytes.substr(0, size)), size, sample.name + text_of(" cut to ", size));
  }
}

TEST(DamagedVolumes, ChangedHeaders) { try_changed(1, 60); }

TEST(DamagedVolumesLong, ChangedHeaders) { try_changed(2, changes_of_long(1000)); }

#if TOOL_HAVE_GDCM

std::string series() {
  bound_memory();
  for (int k = 0; k < 4; ++k) written("s" + std::to_string(k), dicom_slice(k));
  return std::filesystem::path(scratch_path("s0")).parent_path().string();
}

TEST(DamagedDicom, WholeSeries) {
  const Volume volume = volume_of(series());
  EXPECT_EQ(volume.values, (std::vector<float>{-8, -6, -4, -2, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22}));
  EXPECT_EQ(volume.to_world({1, 1, 1}), (Point{1, 1, 2}));
  EXPECT_EQ(volume.space, Space::lps);
}

TEST(DamagedDicom, CutOffAtEveryByte) {
  const std::string folder = series(), whole = dicom_slice(1);
  // Every byte behind the preamble in Long, and here some.
  for (size_t size = 0; size < whole.size() && !HasFailure(); size += 11) {
    written("s1", whole.substr(0, size));
    EXPECT_FALSE(judge(folder, whole.size(), text_of("cut to ", size)));
  }
}

TEST(DamagedDicomLong, CutOffAtEveryByte) {
  const std::string folder = series(), whole = dicom_slice(1);
  for (size_t size = 0; size < whole.size() && !HasFailure(); ++size) {
    written("s1", whole.substr(0, size));
    EXPECT_FALSE(judge(folder, whole.size(), text_of("cut to ", size)));
  }
}

void change_slices(unsigned seed, int count) {
  const std::string folder = series(), whole = dicom_slice(1);
  std::mt19937 random(seed);
  const Sample sample{"s1", whole, whole.size() - 8};
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    const std::string bytes = changed(sample, random);
    written("s1", bytes);
    judge(folder, 4 * bytes.size(), text_of("seed ", seed, ", change ", i));
  }
}

TEST(DamagedDicom, ChangedHeaders) { change_slices(1, 60); }

TEST(DamagedDicomLong, ChangedHeaders) { change_slices(2, changes_of_long(300)); }

#else

TEST(DamagedDicom, NamesTheMissingLibrary) {
  EXPECT_EQ(volume_error("s.dcm", dicom_slice(0)), ": is DICOM, and this build is without GDCM");
}

#endif

}  // namespace
}  // namespace damaged_volumes_test
}  // namespace tool
