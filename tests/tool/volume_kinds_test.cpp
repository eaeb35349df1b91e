// SPDX-License-Identifier: MIT
// Kinds of volume files beyond one plain file: pairs, lists, several time points, encodings, compressed by content.
#include <cmath>

#include "support/file_support.h"

namespace tool {
namespace volume_kinds_test {
namespace {

const std::string voxels = bytes_of_numbers<uint8_t>(eight);
const std::initializer_list<double> later = {11, 12, 13, 14, 15, 16, 17, 110};
const std::vector<float> later_values = {11, 12, 13, 14, 15, 16, 17, 110};

Volume at_time(const std::string& path, uint64_t time) {
  Volume volume;
  const Status status = read_volume(path, {time, false}, volume);
  EXPECT_TRUE(status.ok) << status.message;
  return volume;
}

std::string error_at_time(const std::string& path, uint64_t time) {
  Volume volume;
  const Status status = read_volume(path, {time, false}, volume);
  EXPECT_FALSE(status.ok);
  return status.message.substr(std::min(path.size(), status.message.size()));
}

TEST(NrrdKinds, AsciiAndHex) {
  EXPECT_EQ(volume_of(written("a.nrrd", nrrd("short", "encoding: ascii\n") + "1 2\n3\t4,5 6\r\n7 1e2")).values,
            eight_values);
  EXPECT_EQ(volume_of(written("h.nrrd", nrrd("uchar", "encoding: hex\n") + "01 02\n0304050607 64\n")).values,
            eight_values);
  EXPECT_EQ(
      volume_of(written("i.nrrd", nrrd("short", "encoding: hex\nendian: big\n") + "0001 0002000300040005 000600070064"))
          .values,
      eight_values);
  EXPECT_EQ(volume_error("b.nrrd", nrrd("short", "encoding: ascii\n") + "1 2 3 4 5 6 7"),
            ": 7 voxels, the header asks for 8");
  EXPECT_EQ(volume_error("c.nrrd", nrrd("short", "encoding: ascii\n") + "1 2 3 x"), ": \"x\" is not a number");
  EXPECT_EQ(volume_error("d.nrrd", nrrd("uchar", "encoding: hex\n") + "01 0g"),
            ": character 5 of the voxels is no hex digit");
  EXPECT_EQ(volume_error("e.nrrd", nrrd("uchar", "encoding: hex\n") + "010"),
            ": 1 bytes of voxels, the header asks for 8");
}

TEST(NrrdKinds, SeveralFiles) {
  for (int k = 0; k < 2; ++k) written("s" + std::to_string(k) + ".raw", "xy" + voxels.substr(4 * size_t(k), 4));
  const std::string raw = "encoding: raw\nbyte skip: 2\n";
  EXPECT_EQ(volume_of(written("l.nhdr", nrrd("uchar", raw + "data file: LIST\ns0.raw\ns1.raw"))).values, eight_values);
  EXPECT_EQ(volume_of(written("m.nhdr", nrrd("uchar", raw + "data file: LIST 2\ns0.raw\r\ns1.raw\r\n"))).values,
            eight_values);
  EXPECT_EQ(volume_of(written("p.nhdr", nrrd("uchar", raw + "data file: s%d.raw 0 1 1\n"))).values, eight_values);
  EXPECT_EQ(volume_of(written("q.nhdr", nrrd("uchar", raw + "data file: s%01d.raw 0 1 1 2\n"))).values, eight_values);
  const Volume backward = volume_of(written("r.nhdr", nrrd("uchar", raw + "data file: s%d.raw 1 0 -1\n")));
  EXPECT_EQ(backward.values, (std::vector<float>{5, 6, 7, 100, 1, 2, 3, 4}));
  EXPECT_EQ(volume_error("n.nhdr", nrrd("uchar", raw + "data file: LIST\ns0.raw\ns1.raw\ns1.raw\n")),
            ": 8 voxels are not shared evenly by 3 data files");
  EXPECT_EQ(volume_error("o.nhdr", nrrd("uchar", raw + "data file: LIST")), ": data file LIST without names of files");
  EXPECT_EQ(volume_error("t.nhdr", nrrd("uchar", raw + "data file: s%d%s.raw 0 1 1\n")),
            ": line 8: \"s%d%s.raw\" is no name with one number such as %03d");
  EXPECT_EQ(volume_error("u.nhdr", nrrd("uchar", raw + "data file: s%d.raw 0 1 0\n")),
            ": line 8: 0 to 1 in steps of 0 are no files");
  Volume volume;
  const std::string gone = written("v.nhdr", nrrd("uchar", raw + "data file: LIST\ns0.raw\ns2.raw\n"));
  EXPECT_EQ(read_volume(gone, volume).message, scratch_path("s2.raw") + ": no such file");
}

std::string four_axes(const std::string& sizes, const std::string& more) {
  return "NRRD0004\ntype: uchar\ndimension: 4\nsizes: " + sizes + "\nencoding: raw\n" + more + "\n";
}

TEST(NrrdKinds, TimePoints) {
  const std::string both = voxels + bytes_of_numbers<uint8_t>(later);
  const std::string path = written("t.nrrd", four_axes("2 2 2 2", "") + both);
  Volume volume;
  EXPECT_EQ(read_volume(path, volume).message,
            path + ": line 4: sizes along axis 4 is 2: --time K, from 0 to 1, picks one time point");
  EXPECT_EQ(at_time(path, 0).values, eight_values);
  EXPECT_EQ(at_time(path, 1).values, later_values);
  EXPECT_EQ(error_at_time(path, 2), ": line 4: sizes along axis 4 is 2, so that there is no --time 2");
  // The second time point alone may be cut off.
  const std::string cut = written("c.nrrd", four_axes("2 2 2 2", "") + both.substr(0, 15));
  EXPECT_EQ(at_time(cut, 0).values, eight_values);
  EXPECT_EQ(error_at_time(cut, 1), ": 7 bytes of voxels, the header asks for 8");
  // Slices in files of their own, of which a time point takes two.
  for (int k = 0; k < 4; ++k) written("f" + std::to_string(k), both.substr(4 * size_t(k), 4));
  const std::string list = written("l.nhdr", four_axes("2 2 2 2", "data file: f%d 0 3 1"));
  EXPECT_EQ(at_time(list, 1).values, later_values);
}

// As 3D Slicer writes sequences: the numbers of a voxel side by side.
TEST(NrrdKinds, NumbersSideBySide) {
  std::string mixed;
  for (size_t i = 0; i < 8; ++i) mixed += {voxels[i], static_cast<char>(voxels[i] + 10)};
  const std::string places = "space: LPS\nspace directions: none (2,0,0) (0,3,0) (0,0,4)\nspace origin: (7,8,9)\n";
  for (const std::string& how : {std::string("kinds: list domain domain domain\n") + places, places}) {
    const std::string path = written("s.nrrd", four_axes("2 2 2 2", how) + mixed);
    EXPECT_EQ(at_time(path, 0).values, eight_values);
    const Volume second = at_time(path, 1);
    EXPECT_EQ(second.values, later_values);
    EXPECT_EQ(second.to_world({1, 1, 1}), (Point{9, 11, 13}));
  }
  std::string text;
  for (const char c : mixed) text += std::to_string(static_cast<unsigned char>(c)) + " ";
  std::string header = four_axes("2 2 2 2", "kinds: vector domain domain domain\n");
  header.replace(header.find("raw"), 3, "txt");
  EXPECT_EQ(at_time(written("a.nrrd", header + text), 1).values, later_values);
}

TEST(MetaKinds, SeveralFilesAndText) {
  for (int k = 0; k < 2; ++k) written("s" + std::to_string(k) + ".raw", "xy" + voxels.substr(4 * size_t(k), 4));
  const std::string skip = "HeaderSize = 2\n";
  for (const char* files : {"LIST\ns0.raw\ns1.raw\n", "LIST 2\ns0.raw\ns1.raw", "LIST 2D\r\ns0.raw\r\ns1.raw\r\n",
                            "s%d.raw 0 1 1", "s%d.raw 0 1"})
    EXPECT_EQ(volume_of(written("l.mhd", meta("MET_UCHAR", skip + "ElementDataFile = " + files))).values, eight_values)
        << files;
  const std::string last = "HeaderSize = -1\nElementDataFile = LIST\ns0.raw\ns1.raw\n";
  EXPECT_EQ(volume_of(written("k.mhd", meta("MET_UCHAR", last))).values, eight_values);
  EXPECT_EQ(volume_error("n.mhd", meta("MET_UCHAR", "ElementDataFile = LIST\n")),
            ": ElementDataFile = LIST without names of files");
  const std::string text = "BinaryData = False\nElementDataFile = LOCAL\n1 2 3 4\n5 6 7 100\n";
  EXPECT_EQ(volume_of(written("t.mha", meta("MET_SHORT", text))).values, eight_values);
}

TEST(MetaKinds, TimePoints) {
  const std::string header = "NDims = 4\nDimSize = 2 2 2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\n";
  const std::string path = written("t.mha", header + voxels + bytes_of_numbers<uint8_t>(later));
  EXPECT_EQ(at_time(path, 1).values, later_values);
  Volume volume;
  EXPECT_EQ(read_volume(path, volume).message,
            path + ": line 2: DimSize along axis 4 is 2: --time K, from 0 to 1, picks one time point");
}

TEST(VolumeKinds, NanOnRequest) {
  const std::string path = written("n.nrrd", nrrd("float", "encoding: raw\nendian: little\n") +
                                                 bytes_of_numbers<float>({1, 2, 3, std::nan(""), 5, 6, 7, 8}));
  Volume volume;
  ASSERT_TRUE(read_volume(path, {std::nullopt, true}, volume).ok);
  EXPECT_TRUE(std::isnan(volume.values[3]));
  EXPECT_EQ(volume.values[4], 5);
  EXPECT_FALSE(read_volume(path, volume).ok);
}

#if TOOL_HAVE_BZIP2
TEST(CompressedKinds, Bzip2) {
  const std::string head = nrrd("uchar", "encoding: bzip2\n"), packed = bzipped(voxels);
  EXPECT_EQ(volume_of(written("b.nrrd", head + packed)).values, eight_values);
  const std::string two = bzipped(voxels.substr(0, 3)) + bzipped(voxels.substr(3));
  EXPECT_EQ(volume_of(written("m.nrrd", head + two)).values, eight_values);
  EXPECT_EQ(volume_error("c.nrrd", head + packed.substr(0, packed.size() - 4)),
            ": compressed data cut off after 8 bytes");
  EXPECT_EQ(volume_error("d.nrrd", head + "no bzip2"), ": compressed data damaged after 0 bytes (no bzip2 stream)");
}
#endif

#if TOOL_HAVE_ZLIB
TEST(CompressedKinds, WholeFilesWhateverTheName) {
  const std::string plain = nrrd("uchar", "encoding: raw\n") + voxels;
  for (const char* name : {"a.nrrd", "a.nrrd.gz"})
    EXPECT_EQ(volume_of(written(name, deflated(plain, 31))).values, eight_values) << name;
  const std::string inner = nrrd("uchar", "encoding: gzip\n") + deflated(voxels, 31);
  EXPECT_EQ(volume_of(written("two.nrrd", deflated(inner, 31))).values, eight_values);
  const std::string local = meta("MET_UCHAR", "ElementDataFile = LOCAL\n") + voxels;
  EXPECT_EQ(volume_of(written("a.mha.gz", deflated(local, 31))).values, eight_values);
  // Raw data compressed later on.
  std::string many;
  for (int i = 0; i < 1000; ++i) many += static_cast<char>(i % 7);
  written("d.raw", deflated(many, 31));
  const Volume volume = volume_of(written("d.nhdr", nrrd("uchar", "encoding: raw\ndata file: d.raw\n", "10 10 10")));
  EXPECT_EQ(volume.at(9, 9, 9), 999 % 7);
}
#endif

#if TOOL_HAVE_NIFTI

TEST(NiftiKinds, VersionTwo) {
  for (const bool big : {false, true}) {
    const std::string header = nifti2_header(big, {3, 2, 2, 2, 0, 0, 0, 0}, 4);
    const Volume volume = volume_of(written("a.nii", header + bytes_of_numbers<int16_t>(eight, big)));
    EXPECT_EQ(volume.values, eight_values);
    EXPECT_EQ(volume.to_world({1, 1, 1}), (Point{1, 2, 0.5}));
    EXPECT_EQ(volume.space, Space::ras);
  }
  const std::string header = nifti2_header(false, {4, 2, 2, 2, 2, 0, 0, 0}, 2);
  const std::string path = written("t.nii", header + voxels + bytes_of_numbers<uint8_t>(later));
  EXPECT_EQ(at_time(path, 1).values, later_values);
  EXPECT_EQ(volume_error("s.nii", header.substr(0, 500)), ": too short for a NIfTI header of 540 bytes");
  std::string wrong = header;
  wrong[5] = '-';
  EXPECT_EQ(volume_error("w.nii", wrong + voxels), ": magic is not that of NIfTI-2");
  std::string mark = header;
  mark[8] = 'x';
  EXPECT_EQ(volume_error("x.nii", mark + voxels), ": magic is not that of NIfTI-2");
}

TEST(NiftiKinds, TimePoints) {
  const std::string header = nifti_header(false, {4, 2, 2, 2, 2, 0, 0, 0}, 2);
  const std::string path = written("t.nii", header + voxels + bytes_of_numbers<uint8_t>(later));
  EXPECT_EQ(at_time(path, 0).values, eight_values);
  EXPECT_EQ(at_time(path, 1).values, later_values);
  EXPECT_EQ(error_at_time(path, 7), ": dim[4] is 2, so that there is no --time 7");
  const std::string five = nifti_header(false, {5, 2, 2, 2, 1, 3, 0, 0}, 2);
  EXPECT_EQ(volume_error("f.nii", five + voxels), ": dim[5] is 3, one volume has 1");
}

TEST(NiftiKinds, Pairs) {
  std::string header = nifti_header(false, {3, 2, 2, 2, 0, 0, 0, 0}, 2);
  header.replace(344, 3, "ni1");
  header.replace(108, 4, bytes_of_numbers<float>({3}));
  const std::string by_header = written("p.hdr", header.substr(0, 348)), by_voxels = written("p.img", "xyz" + voxels);
  for (const std::string& path : {by_header, by_voxels}) {
    const Volume volume = volume_of(path);
    EXPECT_EQ(volume.values, eight_values);
    EXPECT_EQ(volume.space, Space::ras);
  }
  written("B.HDR", header);
  EXPECT_EQ(volume_of(written("B.IMG", "xyz" + voxels)).values, eight_values);
  Volume volume;
  EXPECT_EQ(read_volume(written("g.hdr", header), volume).message, scratch_path("g.img") + ": no such file");
#if TOOL_HAVE_ZLIB
  written("z.img.gz", deflated("xyz" + voxels, 31));
  EXPECT_EQ(volume_of(written("z.hdr", header)).values, eight_values);
  EXPECT_EQ(volume_of(written("z.hdr.gz", deflated(header, 31))).values, eight_values);
#endif
  std::string two = nifti2_header(true, {3, 2, 2, 2, 0, 0, 0, 0}, 2);
  two.replace(4, 3, "ni2");
  two.replace(168, 8, std::string(8, '\0'));
  written("q.img", voxels);
  EXPECT_EQ(volume_of(written("q.hdr", two.substr(0, 540))).values, eight_values);
}

TEST(NiftiKinds, AnalyzeHasNoOrientation) {
  for (const bool big : {false, true}) {
    std::string header = nifti_header(big, {4, 2, 2, 2, 1, 0, 0, 0}, 4);
    header.replace(344, 4, std::string(4, '\0'));
    header.replace(108, 4, std::string(4, '\0'));
    written("a.img", bytes_of_numbers<int16_t>(eight, big));
    const Volume volume = volume_of(written("a.hdr", header.substr(0, 348)));
    EXPECT_EQ(volume.values, eight_values);
    EXPECT_EQ(volume.space, Space::unnamed);
    EXPECT_EQ(volume.to_world({1, 1, 1}), (Point{1, 2, 0.5}));
    EXPECT_NE(volume.note.find("Analyze 7.5, which gives no orientation"), std::string::npos) << volume.note;
  }
}

#endif

}  // namespace
}  // namespace volume_kinds_test
}  // namespace tool
