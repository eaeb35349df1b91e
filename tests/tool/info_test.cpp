// SPDX-License-Identifier: MIT
// topoadapt segment --info: what a volume holds, and seeds and thresholds that a segmentation succeeds with.
#include "tool/segment/info.h"

#include <cmath>
#include <cstring>
#include <random>

#include "support/tool_support.h"
#include "tool/view/slice_picture.h"

namespace info_test {
namespace {

using namespace support;
namespace fs = std::filesystem;

// Bytes on a grid of 2 x 1 x 3 mm with a corner at (10, 20, 30).
std::string Nrrd(int nx, int ny, int nz, const std::string& bytes) {
  return "NRRD0004\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes: " + std::to_string(nx) +
         " " + std::to_string(ny) + " " + std::to_string(nz) +
         "\nspace directions: (2,0,0) (0,1,0) (0,0,3)\nspace origin: (10,20,30)\nencoding: raw\n\n" + bytes;
}

class Info : public Tool {
 protected:
  // Two balls of value 200 in 50 with a little noise, of radius 8 and 4 voxels.
  std::string TwoBalls(uint64_t& large, uint64_t& small) const {
    std::mt19937 random(3);
    std::string bytes;
    large = small = 0;
    for (int k = 0; k < 24; ++k)
      for (int j = 0; j < 30; ++j)
        for (int i = 0; i < 40; ++i) {
          const bool in_large = std::hypot(i - 12, j - 14, k - 11) < 8,
                     in_small = std::hypot(i - 30, j - 20, k - 10) < 4;
          large += in_large ? 1u : 0u;
          small += in_small ? 1u : 0u;
          bytes += static_cast<char>((in_large || in_small ? 200 : 50) + static_cast<int>(random() % 21) - 10);
        }
    return Write("balls.nrrd", Nrrd(40, 30, 24, bytes));
  }
};

TEST_F(Info, TwoClassesAndSeeds) {
  uint64_t large = 0, small = 0;
  const std::string file = TwoBalls(large, small);
  const Ended run = Call("segment --info " + file + " --json " + At("r.json") + " --png " + At("p.png"));
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const std::string& words :
       {std::string("40 x 30 x 24 voxels of 2 x 1 x 3 mm, world lps"),
        std::string("box (9,19.5,28.5) to (89,49.5,100.5) mm"), "bright: " + std::to_string(large + small) + " voxels",
        "in 2 parts; the largest has " + std::to_string(large), std::string("seed 12,14,11 (34,34,63 mm)"),
        std::string("Otsu 1979"), std::string("dark: ")})
    EXPECT_NE(run.out.find(words), std::string::npos) << words << "\n" << run.out;
  const std::string report = Contents(At("r.json"));
  ExpectKeys(report, {"version", "size", "spacing_mm", "space", "box_mm", "histogram", "threshold", "dark", "bright",
                      "labels"});
  for (const std::string& words :
       {std::string("\"size\":[40,30,24]"), std::string("\"box_mm\":[[9,19.5,28.5],[89,49.5,100.5]]"),
        "\"largest\":" + std::to_string(large), std::string("\"seed\":[12,14,11]"),
        std::string("\"seed_mm\":[34,34,63]"), std::string("\"labels\":[]")})
    EXPECT_NE(report.find(words), std::string::npos) << words << "\n" << report;
  EXPECT_EQ(Contents(At("p.png")).substr(0, 8), "\x89PNG\r\n\x1a\n");
  // The command that the text proposes fills the ball.
  const size_t at = run.out.rfind("topoadapt segment "), end = run.out.find('\n', at);
  ASSERT_NE(at, std::string::npos) << run.out;
  const std::string command = run.out.substr(at + 10, end - at - 10);
  EXPECT_NE(command.find("--bright"), std::string::npos) << command;
  const Ended filled = Call(command + " --genus 0 --quiet");
  EXPECT_EQ(filled.exit_code, 0) << command << filled.out << filled.err;
  // A threshold of the user's, and only the report on standard output.
  const Ended given = Call("segment --info " + file + " --threshold 55 --json -");
  ExpectKeys(given.out, {"threshold"});
  EXPECT_NE(given.out.find("\"threshold\":55,\"threshold_is_given\":true"), std::string::npos) << given.out;
}

TEST_F(Info, LabelsAreListed) {
  std::string bytes(10 * 10 * 10, '\0');
  for (int i = 0; i < 30; ++i) bytes[static_cast<size_t>(400 + i)] = 3;
  for (int i = 0; i < 7; ++i) bytes[static_cast<size_t>(700 + i)] = 9;
  const Ended run = Call("segment --info " + Write("labels.nrrd", Nrrd(10, 10, 10, bytes)) + " --json " + At("r.json"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* words : {"label 3: 30 voxels", "label 9: 7 voxels"})
    EXPECT_NE(run.out.find(words), std::string::npos) << words << run.out;
  EXPECT_NE(Contents(At("r.json")).find("\"labels\":[{\"label\":3,\"voxels\":30},{\"label\":9,\"voxels\":7}]"),
            std::string::npos);
}

// A soft ball has few whole numbers; patches of three labels lie side by side.
TEST_F(Info, AScanWithSoftBordersIsNoLabelMap) {
  std::string soft, map;
  for (int k = 0; k < 16; ++k)
    for (int j = 0; j < 16; ++j)
      for (int i = 0; i < 16; ++i) {
        const double r = std::hypot(i - 8, j - 8, k - 8);
        soft += static_cast<char>(std::clamp(static_cast<int>(10 * (6 - r)), 0, 40));
        map += static_cast<char>(r < 6 ? 1 + i / 6 : 0);
      }
  EXPECT_EQ(Call("segment --info " + Write("soft.nrrd", Nrrd(16, 16, 16, soft))).out.find("label "), std::string::npos);
  const Ended run = Call("segment --info " + Write("map.nrrd", Nrrd(16, 16, 16, map)));
  for (const char* words : {"label 1: ", "label 2: ", "label 3: "})
    EXPECT_NE(run.out.find(words), std::string::npos) << words << run.out;
}

TEST_F(Info, OddVolumes) {
  for (const auto& [name, bytes] : {std::pair{"one.nrrd", std::string(1, '\5')}, {"flat.nrrd", std::string(1, '\0')}})
    EXPECT_EQ(Call("segment --info " + Write(name, Nrrd(1, 1, 1, bytes)) + " --png " + At("p.png")).exit_code, 0)
        << name;
  EXPECT_EQ(Call("segment --info " + Write("thin.nrrd", Nrrd(8, 8, 1, std::string(32, '\1') + std::string(32, '\2'))))
                .exit_code,
            0);
  EXPECT_EQ(Call("segment --info --phantom genus-3 --quiet").exit_code, 0);
  Refuse("segment --info", {"VOLUME"});
  Refuse("segment --info " + At("one.nrrd") + " --out " + At("m.ply"), {"--out", "--info"});
  Refuse("segment --info " + At("absent.nrrd"), {"absent.nrrd"});
}

TEST_F(Info, ASeedBesideTheObjectIsToldWhereTheObjectLies) {
  uint64_t large = 0, small = 0;
  const std::string file = TwoBalls(large, small);
  // From (30, 27, 10) the small ball's nearest voxel is straight back along j: 20 + 3.
  Refuse("segment " + file + " --seed 30,27,10 --threshold 125 --bright",
         {"seed 30,27,10", "(mm) lies outside the object", "nearest voxel of the object is 30,23,10", "at 70,43,60 mm",
          " 4 mm away"});
  Refuse("segment " + file + " --seed-mm 70,60,60 --threshold 125 --bright",
         {"outside the volume", "nearest voxel of the object is 30,23,10", "17 mm away"});
  Refuse("segment " + file + " --seed 30,27,10 --threshold 250 --bright", {"no voxel is above the threshold"});
  // Bands and labels are told as such.
  Refuse("segment " + file + " --seed 30,27,10 --lower 180 --upper 260",
         {"outside of --lower to --upper there", "nearest voxel of the object is 30,23,10"});
  Refuse("segment " + file + " --seed 30,27,10 --lower 250 --upper 260", {"no voxel lies between --lower and --upper"});
  std::string labels(10 * 10 * 10, '\0');
  labels[321] = 7;
  const std::string map = Write("map.nrrd", Nrrd(10, 10, 10, labels));
  Refuse("segment " + map + " --seed 1,2,4 --label 7",
         {"the label is another there", "nearest voxel of the object is 1,2,3, at 12,22,39 mm, 3 mm away"});
  Refuse("segment " + map + " --seed 1,2,4 --label 8", {"the label is another there", "no voxel has the label"});
}

// Over all cuts between two values, the variance within both classes, by its definition.
TEST(Otsu, HasTheLeastVarianceWithinClasses) {
  std::mt19937 random(79);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<uint64_t> counts(32);
    for (int i = 0; i < 400; ++i) {
      std::normal_distribution<double> normal(trial % 2 == 0 && i % 3 == 0 ? 24 : 9, 1.0 + trial % 5);
      ++counts[static_cast<size_t>(std::clamp(normal(random), 0.0, 31.0))];
    }
    const double threshold = tool::otsu_threshold(counts, 0, 32);
    const auto within = [&](double cut) {
      double sum = 0;
      for (const bool above : {false, true}) {
        double n = 0, mean = 0;
        for (size_t b = 0; b < 32; ++b)
          if ((static_cast<double>(b) + 0.5 > cut) == above)
            n += static_cast<double>(counts[b]), mean += static_cast<double>(counts[b] * b);
        if (n == 0) return INFINITY;
        mean /= n;
        for (size_t b = 0; b < 32; ++b)
          if ((static_cast<double>(b) + 0.5 > cut) == above)
            sum += static_cast<double>(counts[b]) * std::pow(static_cast<double>(b) - mean, 2);
      }
      return static_cast<float>(sum);
    };
    for (int cut = 1; cut < 32; ++cut) EXPECT_LE(within(threshold), within(cut) * 1.000001f) << trial << " " << cut;
  }
}

// On a slope, every point of the contour lies at the level, and the contour passes every row once.
TEST(LevelContour, LiesAtTheLevel) {
  tool::Slice s;
  s.width = 9;
  s.height = 7;
  for (int y = 0; y < s.height; ++y)
    for (int x = 0; x < s.width; ++x) s.grey.push_back(static_cast<float>(3 * x + y));
  const auto contour = tool::level_contour(s, 12.5);
  EXPECT_FALSE(contour.empty());
  double height = 0;
  for (const auto& line : contour) {
    EXPECT_NEAR(3 * line[0] + line[1], 12.5, 1e-9);
    EXPECT_NEAR(3 * line[2] + line[3], 12.5, 1e-9);
    height += std::fabs(line[3] - line[1]);
  }
  EXPECT_NEAR(height, 6, 1e-9);
}

}  // namespace
}  // namespace info_test
