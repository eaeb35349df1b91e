// SPDX-License-Identifier: MIT
// Volumes, and their files. Real volumes are looked for in TOPOADAPT_SHARED_DATA.
#include <cmath>
#include <filesystem>
#include <random>

#include "support/file_support.h"

namespace tool {
namespace volume_files_test {
namespace {

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
  for (const double tiny : {0.009, 1e-12, 1e-300}) {
    const std::vector<float> before = volume.values;
    ASSERT_TRUE(smooth_gaussian(volume, tiny).ok);
    EXPECT_EQ(volume.values, before) << tiny;
  }
  EXPECT_FALSE(smooth_gaussian(volume, -1).ok);
  EXPECT_FALSE(smooth_gaussian(volume, std::nan("")).ok);
}

TEST(VolumeFiles, MissingAndUnknown) {
  Volume volume;
  EXPECT_EQ(read_volume("/no/such.nrrd", volume).message, "/no/such.nrrd: no such file");
  EXPECT_EQ(read_volume("a.tiff", volume).message,
            "a.tiff: unknown volume format (known: .nii .hdr .img .nrrd .nhdr .mha .mhd .mgh .mgz, also with .gz or "
            ".bz2, and DICOM "
            "folders and files)");
  std::filesystem::create_directories(scratch_path("folder.mha"));
  EXPECT_EQ(read_volume(scratch_path("folder.mha"), volume).message, scratch_path("folder.mha") + ": is not a file");
}

TEST(Nrrd, EveryTypeAndByteOrder) {
  const auto check = [](const std::string& type, bool big, const std::string& bytes) {
    const std::string head = nrrd(type, std::string("encoding: raw\nendian: ") + (big ? "big\n" : "little\n"));
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
  const std::string skips = "encoding: raw\nspacings: 1 -0.5 nan\ndata file: ./v.raw\nline skip: 2\nbyte skip: 3";
  const Volume volume = volume_of(written("v.nhdr", nrrd("uchar", skips)));
  EXPECT_EQ(volume.values, eight_values);
  EXPECT_EQ(volume.to_world.spacing(0), 1);
  EXPECT_EQ(volume.to_world.spacing(1), 0.5);
  EXPECT_EQ(volume.to_world.spacing(2), 1);
  const std::string tail = "encoding: raw\nspace directions: (0,3,4) (0,2,0) (1,0,0)\ndatafile: v.raw\nbyteskip: -1";
  const Volume last = volume_of(written("w.nhdr", nrrd("uchar", tail)));
  EXPECT_EQ(last.values, eight_values);
  EXPECT_EQ(last.to_world.spacing(0), 5);
}

// Where the map of a volume takes an index.
Point place_of(const Volume& volume, double i, double j, double k) { return volume.to_world({i, j, k}); }

TEST(Nrrd, WorldIsAsDeclared) {
  const std::string tail = "space directions: (0,3,0) (-2,0,0) (0,0,0.5)\nspace origin: (10,20,30)\nencoding: raw\n\n" +
                           bytes_of_numbers<uint8_t>(eight);
  const Volume lps = volume_of(written("a.nrrd", nrrd("uchar", "space: left-posterior-superior\n" + tail)));
  EXPECT_EQ(lps.space, Space::lps);
  EXPECT_EQ(place_of(lps, 1, 2, 4), (Point{6, 23, 32}));
  EXPECT_GT(determinant(lps.to_world), 0);
  const Volume ras = volume_of(written("b.nrrd", nrrd("uchar", "space: RAS\n" + tail)));
  EXPECT_EQ(ras.space, Space::ras);
  EXPECT_EQ(place_of(ras, 1, 2, 4), (Point{6, 23, 32}));
  // x grows to the left: RAS with the other sign.
  const Volume las = volume_of(written("c.nrrd", nrrd("uchar", "space: left-anterior-superior\n" + tail)));
  EXPECT_EQ(las.space, Space::ras);
  EXPECT_EQ(place_of(las, 1, 2, 4), (Point{-6, 23, 32}));
  EXPECT_LT(determinant(las.to_world), 0);
  EXPECT_EQ(volume_of(written("d.nrrd", nrrd("uchar", tail))).space, Space::unnamed);
  EXPECT_EQ(volume_error("e.nrrd", nrrd("uchar", "space directions: (1,0,0) (2,0,0) (0,0,1)\nencoding: raw\n\n")),
            ": space directions and space origin give voxels no place or no volume");
}

TEST(Nrrd, SpacingsAndUnits) {
  const std::string raw = "encoding: raw\n", voxels = "\n" + bytes_of_numbers<uint8_t>(eight);
  const std::string directions = "space: RAS\nspace directions: (0,3,0) (-2,0,0) (0,0,0.5)\nspace origin: (10,20,30)\n";
  for (const std::string& both : {"spacings: 7 7 7\n" + directions, directions + "spacings: 7 7 7\n"})
    EXPECT_EQ(place_of(volume_of(written("a.nrrd", nrrd("uchar", both + raw + voxels))), 1, 2, 4), (Point{6, 23, 32}));
  const std::string partly = "space: RAS\nspace directions: (2,0,0) (0,3,0) none\nspacings: nan nan 5\n";
  EXPECT_EQ(place_of(volume_of(written("p.nrrd", nrrd("uchar", partly + raw + voxels))), 1, 1, 1), (Point{2, 3, 5}));
  const std::string metres = directions + "space units: \"m\" \"cm\" \"mm\"\n";
  EXPECT_EQ(place_of(volume_of(written("m.nrrd", nrrd("uchar", metres + raw + voxels))), 1, 2, 4),
            (Point{6000, 230, 32}));
  const std::string microns = "spacings: 500 2 1\nunits: \"um\" \"cm\" \"mm\"\n";
  const Volume plain = volume_of(written("u.nrrd", nrrd("uchar", microns + raw + voxels)));
  EXPECT_EQ(place_of(plain, 1, 1, 1), (Point{0.5, 20, 1}));
  EXPECT_EQ(plain.note, "");
  const std::string strange = "spacings: 2 2 2\nunits: \"cubit\" \"mm\" \"mm\"\n";
  const Volume noted = volume_of(written("s.nrrd", nrrd("uchar", strange + raw + voxels)));
  EXPECT_EQ(place_of(noted, 1, 1, 1), (Point{2, 2, 2}));
  EXPECT_NE(noted.note.find("cubit"), std::string::npos) << noted.note;
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
            ": line 5: sizes gives 4 numbers, dimension gives 3");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", raw, "99999 99999 99999") + voxels),
            ": line 5: sizes 99999 x 99999 x 99999 give more than the limit of 2147483648 voxels");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", raw, "4294967296 4294967296 4294967296") + voxels),
            ": line 5: sizes 4294967296 x 4294967296 x 4294967296 give more than the limit of 2147483648 voxels");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", raw, "99999999999999999999 1 1") + voxels),
            ": line 5: sizes gives \"99999999999999999999\"");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", raw, "1 1 2147483648") + voxels),
            ": line 5: sizes gives 2147483648, more than 2147483647 along one axis");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("block", raw)), ": line 3: type \"block\" is not a real or integer number");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", "encoding: xz\n")),
            ": line 6: encoding \"xz\" is not read (raw, gzip, bzip2, hex and ascii are)");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("short", raw) + voxels), ": the header gives no endian");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", "")), ": the header gives no encoding");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", "nonsense\n")), ": line 6: no \"field: value\"");
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", "line skip: -3\n")), ": line 6: line skip gives \"-3\"");
}

TEST(Nrrd, RefusesDataThatIsNotThere) {
  const std::string raw = "encoding: raw\nendian: little\n", voxels = bytes_of_numbers<uint8_t>(eight);
  EXPECT_EQ(volume_error("a.nrrd", nrrd("ushort", raw) + voxels), ": 8 bytes of voxels, the header asks for 16");
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
            ": voxel (0, 1, 1) is not finite (NaN; --nan-as-background takes NaN for background)");
  EXPECT_EQ(volume_error("a.nrrd", head + bytes_of_numbers<float>({1, infinity, 3, 4, 5, 6, 7, 8})),
            ": voxel (1, 0, 0) is not finite");
}

TEST(MetaImage, TypesByteOrdersAndFiles) {
  const std::string local = "ElementSpacing = 1 2 0.5\nElementDataFile = LOCAL\n";
  const Volume volume = volume_of(written("a.mha", meta("MET_SHORT", local) + bytes_of_numbers<int16_t>(eight)));
  EXPECT_EQ(volume.values, eight_values);
  EXPECT_EQ(volume.to_world.spacing(2), 0.5);
  const std::string msb = meta("MET_DOUBLE", "ElementByteOrderMSB = True\n" + local);
  EXPECT_EQ(volume_of(written("b.mha", msb + bytes_of_numbers<double>(eight, true))).values, eight_values);
  const std::string four_sizes = "NDims = 4\nDimSize = 2 2 2 1\nElementType = MET_ULONG\nElementDataFile = LOCAL\n";
  EXPECT_EQ(volume_of(written("c.mha", four_sizes + bytes_of_numbers<uint32_t>(eight))).values, eight_values);
  written("d.raw", "some head" + bytes_of_numbers<uint8_t>(eight));
  const std::string beside_it = meta("MET_UCHAR", "HeaderSize = -1\nElementDataFile = d.raw\n");
  EXPECT_EQ(volume_of(written("d.mhd", beside_it)).values, eight_values);
  const std::string after_head = meta("MET_UCHAR", "HeaderSize = 9\r\nElementDataFile = d.raw\r\n");
  EXPECT_EQ(volume_of(written("e.mhd", after_head)).values, eight_values);
}

TEST(MetaImage, WorldIsLps) {
  // A row of the matrix is the direction of an axis, as ITK writes them.
  const std::string local =
      "TransformMatrix = 0 1 0 -1 0 0 0 0 1\nOffset = 10 20 30\nElementSpacing = 3 2 0.5\n"
      "ElementDataFile = LOCAL\n";
  const Volume volume = volume_of(written("a.mha", meta("MET_UCHAR", local) + bytes_of_numbers<uint8_t>(eight)));
  EXPECT_EQ(volume.space, Space::lps);
  EXPECT_EQ(volume.to_world({1, 2, 4}), (Point{6, 23, 32}));
  const std::string five =
      "NDims = 5\nDimSize = 2 2 2 1 1\nElementType = MET_UCHAR\nOffset = 10 20 30 0 0\nElementSpacing = 3 2 0.5 1 1\n"
      "TransformMatrix = 0 1 0 0 0 -1 0 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 0 1\nElementDataFile = LOCAL\n";
  EXPECT_EQ(volume_of(written("f.mha", five + bytes_of_numbers<uint8_t>(eight))).to_world({1, 2, 4}),
            (Point{6, 23, 32}));
  const std::string sixteen = "TransformMatrix = 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\nElementDataFile = LOCAL\n";
  EXPECT_EQ(volume_error("g.mha", meta("MET_UCHAR", sixteen) + bytes_of_numbers<uint8_t>(eight)),
            ": TransformMatrix gives 16 numbers, 9 are needed");
  const std::string flat = "TransformMatrix = 1 0 0 1 0 0 0 0 1\nElementDataFile = LOCAL\n";
  EXPECT_EQ(volume_error("b.mha", meta("MET_UCHAR", flat) + bytes_of_numbers<uint8_t>(eight)),
            ": ElementSpacing, TransformMatrix and Offset give voxels no place or no volume");
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
  EXPECT_EQ(volume_error("a.mha", meta("MET_INT", local) + voxels), ": 8 bytes of voxels, the header asks for 32");
  EXPECT_EQ(volume_error("a.mha", meta("MET_INT", "ElementNumberOfChannels = 3\n" + local)),
            ": line 5: ElementNumberOfChannels gives 3, one volume has 1");
  EXPECT_EQ(volume_error("a.mhd", meta("MET_INT", "ElementDataFile = slice%03d.raw\n")),
            ": line 5: \"slice%03d.raw\" lacks the first and last number of the files");
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
  EXPECT_EQ(volume.to_world.spacing(1), 2);
  EXPECT_EQ(volume.to_world.spacing(2), 0.5);
}

// The number in a header's place, and the header's voxels behind.
template <class T>
void put(std::string& file, size_t place, std::initializer_list<double> numbers) {
  const std::string bytes = bytes_of_numbers<T>(numbers);
  file.replace(place, bytes.size(), bytes);
}

TEST(Nifti, WorldIsTheSformElseTheQform) {
  std::string file = nifti_header(false, {3, 2, 2, 2, 1, 0, 0, 0}, 2) + bytes_of_numbers<uint8_t>(eight);
  put<float>(file, 80, {3, 2, 0.5});
  const Volume neither = volume_of(written("n.nii", file));
  EXPECT_EQ(neither.to_world({1, 2, 4}), (Point{3, 4, 2}));
  EXPECT_EQ(neither.space, Space::ras);
  std::string negative = file;
  put<float>(negative, 80, {-3, 2, -0.5});
  EXPECT_EQ(volume_of(written("g.nii", negative)).to_world({1, 2, 4}), (Point{3, 4, 2}));
  // A half turn about z: (i, j, k) to (-3 i, -2 j, k / 2).
  put<int16_t>(file, 252, {1, 0});
  put<float>(file, 256, {0, 0, 1, 10, 20, 30});
  const Volume qform = volume_of(written("q.nii", file));
  const Point at = qform.to_world({1, 2, 4}), expected = {7, 16, 32};
  for (size_t k = 0; k < 3; ++k) EXPECT_NEAR(at[k], expected[k], 1e-5);
  std::string backward = file;
  put<float>(backward, 80, {-3, 2, -0.5});
  EXPECT_EQ(volume_of(written("b.nii", backward)).to_world({1, 2, 4}), at);
  put<int16_t>(file, 252, {1, 2});
  put<float>(file, 280, {0, -2, 0, 10, 3, 0, 0, 20, 0, 0, 0.5, 30});
  EXPECT_EQ(volume_of(written("s.nii", file)).to_world({1, 2, 4}), (Point{6, 23, 32}));
  // A unit of metres is a thousand millimetres.
  std::string metres = file;
  metres[123] = 1;
  EXPECT_EQ(volume_of(written("m.nii", metres)).to_world({1, 2, 4}), (Point{6000, 23000, 32000}));
  // An sform without volume is none.
  put<float>(file, 280, {0, -2, 0, 10, 0, 0, 0, 20});
  EXPECT_NEAR(volume_of(written("z.nii", file)).to_world({1, 2, 4})[0], 7, 1e-5);
}

TEST(Nifti, TakesWhatPeopleHave) {
  std::string file = nifti_header(false, {3, 2, 2, 2, 1, 0, 0, 0}, 2) + bytes_of_numbers<uint8_t>(eight);
  put<float>(file, 108, {0});
  const Volume early = volume_of(written("o.nii", file));
  EXPECT_EQ(early.values, eight_values);
  EXPECT_NE(early.note.find("vox_offset"), std::string::npos);
}

TEST(Nifti, RefusesBadHeadersAndData) {
  const std::string voxels = bytes_of_numbers<uint8_t>(eight);
  const auto header = [](std::array<int16_t, 8> dim, int16_t type = 2) { return nifti_header(false, dim, type); };
  EXPECT_EQ(volume_error("a.nii", "short"), ": too short for a NIfTI header of 348 bytes");
  EXPECT_EQ(volume_error("a.nii", std::string(400, 'x')),
            ": sizeof_hdr is 2021161080, NIfTI-1 has 348 and NIfTI-2 540");
  EXPECT_EQ(volume_error("a.nii", header({3, 2, 0, 2}) + voxels), ": dim: sizes gives 0");
  EXPECT_EQ(volume_error("a.nii", header({3, 2, -7, 2}) + voxels), ": dim: sizes gives -7");
  EXPECT_EQ(volume_error("a.nii", header({3, 32767, 32767, 32767}) + voxels),
            ": dim: sizes 32767 x 32767 x 32767 give more than the limit of 2147483648 voxels");
  EXPECT_EQ(volume_error("a.nii", header({2, 2, 2, 2}) + voxels), ": dim[0] gives 2 dimensions, 3 are needed");
  EXPECT_EQ(volume_error("a.nii", header({4, 2, 2, 2, 5}) + voxels),
            ": dim[4] is 5: --time K, from 0 to 4, picks one time point");
  EXPECT_EQ(volume_error("a.nii", header({3, 2, 2, 2}, 32) + voxels), ": datatype 32 is not a real or integer number");
  EXPECT_EQ(volume_error("a.nii", header({3, 2, 2, 2}, 16) + voxels), ": 8 bytes of voxels, the header asks for 32");
  std::string unmarked = header({3, 2, 2, 2});
  unmarked.replace(344, 3, "n+0");
  EXPECT_EQ(volume_error("a.nii", unmarked + voxels),
            ": magic is neither \"n+1\" nor \"n+2\", the marks of NIfTI in one file");
  const std::string floats = nifti_header(false, {3, 2, 1, 1, 0, 0, 0, 0}, 16);
  EXPECT_EQ(volume_error("a.nii", floats + bytes_of_numbers<float>({1, std::nan("")})),
            ": voxel (1, 0, 0) is not finite (NaN; --nan-as-background takes NaN for background)");
}

#else

TEST(Nifti, NamesTheMissingLibrary) {
  EXPECT_EQ(volume_error("a.nii", nifti_header(false, {3, 2, 2, 2}, 2)),
            ": is NIfTI, and this build is without niftilib");
}

#endif

#if TOOL_HAVE_ZLIB

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
  EXPECT_EQ(volume_of(written("c.nrrd", skipping + "a line\n" + deflated("xy" + voxels, 31))).values, eight_values);
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
TEST(Compressed, GzipWhateverTheName) {
  const std::string file = nifti_header(false, {3, 2, 2, 2, 1, 0, 0, 0}, 2) + bytes_of_numbers<uint8_t>(eight);
  EXPECT_EQ(volume_of(written("g.nii", deflated(file, 15 + 16))).values, eight_values);
}

TEST(Compressed, Nifti) {
  const std::string plain = nifti_header(false, {3, 2, 2, 2, 0, 0, 0, 0}, 2) + bytes_of_numbers<uint8_t>(eight);
  const std::string packed = deflated(plain, 31);
  EXPECT_EQ(volume_of(written("a.nii.gz", packed)).values, eight_values);
  const std::string cut = volume_error("a.nii.gz", packed.substr(0, packed.size() - 12));
  EXPECT_EQ(cut.substr(0, 32), ": compressed data cut off after ") << cut;
  EXPECT_EQ(volume_of(written("b.nii.gz", plain)).values, eight_values);
}
#endif

#else

TEST(Compressed, NamesTheMissingLibrary) {
  EXPECT_EQ(volume_error("a.nrrd", nrrd("uchar", "encoding: gzip\n")),
            ": is compressed (gzip), and this build is without zlib");
}

#endif

TEST(RealData, Tooth) {
  const std::string path = real_file("volumes/tooth.nhdr");
  if (path.empty()) GTEST_SKIP() << "no real data in " << TOPOADAPT_SHARED_DATA;
  const Volume tooth = volume_of(path);
#ifdef TOPOADAPT_HAS_OWN_DATA
  EXPECT_EQ(tooth.nx, 13);
  EXPECT_EQ(tooth.ny, 11);
  EXPECT_EQ(tooth.nz, 9);
  EXPECT_EQ(tooth.at(12, 7, 5), 256 * 5 + 16 * 7 + 12);  // tests/data/make_data.py
#else
  EXPECT_EQ(tooth.nx, 103);
  EXPECT_EQ(tooth.ny, 94);
  EXPECT_EQ(tooth.nz, 161);
  EXPECT_EQ(tooth.at(50, 40, 80), 3 * 256 + 64);  // od -j 1557460 -N 2 -t u1 tooth.raw
#endif
}

#if TOOL_HAVE_NIFTI && TOOL_HAVE_ZLIB
TEST(RealData, Nifti) {
  const std::string path = real_file("volumes/engine.nii.gz");
  if (path.empty()) GTEST_SKIP() << "no real data in " << TOPOADAPT_SHARED_DATA;
  const Volume engine = volume_of(path);
  const Volume vessels = volume_of(real_file("volumes/avf_float_32.nii.gz"));
#ifdef TOPOADAPT_HAS_OWN_DATA
  EXPECT_EQ(engine.nx, 12);
  EXPECT_EQ(engine.ny, 10);
  EXPECT_EQ(engine.nz, 8);
  EXPECT_EQ(engine.at(11, 9, 7), 3 * 11 + 7 * 9 + 11 * 7);  // tests/data/make_data.py
  EXPECT_EQ(vessels.nx, 6);
  EXPECT_EQ(vessels.at(5, 3, 2), 5 + 3 / 4.0 + 100 * 2);
#else
  EXPECT_EQ(engine.nx, 256);
  EXPECT_EQ(engine.ny, 256);
  EXPECT_EQ(engine.nz, 128);
  EXPECT_EQ(engine.at(130, 120, 60), 122);  // od -j 3963362 -N 1 -t u1, unpacked
  EXPECT_EQ(vessels.nx, 74);
  EXPECT_EQ(vessels.ny, 93);
  EXPECT_EQ(vessels.nz, 20);
  EXPECT_NEAR(vessels.at(37, 46, 10), 364.3384, 0.0001);
#endif
}
#endif

}  // namespace
}  // namespace volume_files_test
}  // namespace tool
