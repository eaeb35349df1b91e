// SPDX-License-Identifier: MIT
// The tool: what it takes, what it says about doubtful input, and what every command has in common.
#include <array>
#include <cmath>
#include <map>

#include "support/tool_support.h"

namespace inputs_test {
namespace {

using namespace support;
namespace fs = std::filesystem;
using Inputs = Tool;

// A box as six squares, side by side.
std::string Box(double x, double y, double z, double size, bool inward) {
  std::ostringstream text;
  text.precision(17);
  text << "OFF\n8 6 0\n";
  for (int k = 0; k < 8; ++k)
    text << x + (k & 1 ? size : 0) << " " << y + (k & 2 ? size : 0) << " " << z + (k & 4 ? size : 0) << "\n";
  constexpr int squares[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& s : squares)
    text << 4 << " " << s[0] << " " << s[inward ? 3 : 1] << " " << s[2] << " " << s[inward ? 1 : 3] << "\n";
  return text.str();
}

int Lines(const std::string& text) { return static_cast<int>(std::count(text.begin(), text.end(), '\n')); }

Mesh Read(const std::string& path) {
  Mesh m;
  const tool::Status s = tool::read_mesh(path, m);
  EXPECT_TRUE(s.ok) << s.message;
  return m;
}

TEST_F(Inputs, FacesThatAreNotConvex) {
  // A prism over a U, a pit between two towers: a fan from any corner leaves the U.
  const std::string caps = "8 7 6 5 4 3 2 1 0\n8 8 9 10 11 12 13 14 15\n";
  std::string file = "OFF\n16 10 0\n";
  for (const char* z : {" 0\n", " 1\n"})
    for (const char* p : {"0 0", "5 0", "5 5", "4 5", "4 1", "1 1", "1 5", "0 5"}) file += p + std::string(z);
  file += caps;
  for (int i = 0; i < 8; ++i) {
    const int j = (i + 1) % 8;
    for (const int corner : {4, i, j, j + 8, i + 8}) file += std::to_string(corner) + " ";
    file += "\n";
  }
  const std::string path = Write("u.off", file);
  const Ended detected = Call("detect " + path);
  EXPECT_EQ(detected.exit_code, 0) << detected.out;
  EXPECT_EQ(detected.out, "0 pairs\n");
  EXPECT_EQ(Call("resolve " + path + " --out " + At("out.off")).exit_code, 0);
  EXPECT_NEAR(TopologyOf(Read(At("out.off"))).Volume(), 13, 1e-12);
  for (const Mesh& m : {Read(path), Read(At("out.off"))}) EXPECT_TRUE(IsSound(m, "U"));
}

TEST_F(Inputs, InsideOutIsNamedAndTurned) {
  for (const double place : {0.0, 1e6}) {
    const std::string path = Write("in.off", Box(place, place, -place, 1, true));
    for (const std::string command : {"detect ", "validate "}) {
      const Ended run = Call(command + path);
      EXPECT_EQ(run.exit_code, 0) << run.err;
      EXPECT_EQ(Lines(run.err), 1) << run.err;
      for (const char* word : {"note: ", "in.off", "inside out", "-1", "--turn"})
        EXPECT_NE(run.err.find(word), std::string::npos) << word << ": " << run.err;
      EXPECT_EQ(Call(command + path + " --quiet").err, "");
      EXPECT_EQ(Call(command + path + " --turn").err, "");
    }
    for (const std::string quiet : {"", " --quiet"})
      Refuse("resolve " + path + " --out " + At("never.off") + quiet, {"in.off", "inside out", "--turn"});
    EXPECT_FALSE(fs::exists(At("never.off")));
    const Ended turned = Call("resolve " + path + " --turn --out " + At("box.off"));
    EXPECT_EQ(turned.exit_code, 0) << turned.err;
    EXPECT_EQ(turned.err, "");
    const Mesh box = Read(At("box.off"));
    EXPECT_TRUE(IsSound(box, "box"));
    EXPECT_NEAR(TopologyOf(box).Volume(), 1, 1e-9 * std::max(1.0, place));
    Refuse("resolve " + At("box.off") + " --turn --out " + At("never.off"), {"inside out once turned", "leave out"});
  }
}

TEST_F(Inputs, InsideOutCountsTheWholeMesh) {
  const auto turned = [](Mesh m) {
    for (size_t f = 0; f < m.triangles.size(); f += 3) std::swap(m.triangles[f + 1], m.triangles[f + 2]);
    return m;
  };
  const Mesh outer = Sphere({0, 0, 0}, 1, 6), inner = Sphere({0, 0, 0}, 0.5, 4);
  const std::string shell = Write("shell.off", Together({outer, turned(inner)}));
  EXPECT_EQ(Call("detect " + shell).err, "");
  EXPECT_EQ(Call("resolve " + shell + " --out " + At("shell.ply")).exit_code, 0);
  const std::string hole = Write("hole.off", Together({turned(outer), inner}));
  EXPECT_EQ(Lines(Call("detect " + hole).err), 1);
  // Nothing inside: the sign of the volume is one of rounding.
  const std::string nothing = Write("nothing.off", Together({outer, turned(outer)}));
  EXPECT_EQ(Call("validate " + nothing).err, "");
}

TEST_F(Inputs, TinyCoordinatesAreZero) {
  std::string file = Box(0, 0, 0, 1, false);
  const size_t first = file.find("0 0 0\n");
  const std::string plain = Write("plain.off", file);
  const std::string tiny = Write("tiny.off", file.replace(first, 5, "1.58e-33 -7.8e-31 4e-324"));
  const std::string resolve = "resolve --out " + At("tiny.ply") + " ";
  for (const std::string& command : {std::string("detect "), std::string("validate "), resolve}) {
    const Ended run = Call(command + tiny);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(Lines(run.err), 1) << run.err;
    for (const char* word : {"note: ", "tiny.off", "3 coordinates", "2^-100"})
      EXPECT_NE(run.err.find(word), std::string::npos) << word << ": " << run.err;
    EXPECT_EQ(Call(command + tiny + " --quiet").err, "");
  }
  EXPECT_EQ(Call("resolve " + plain + " --out " + At("plain.ply")).err, "");
  EXPECT_EQ(Contents(At("tiny.ply")), Contents(At("plain.ply")));
  // 2^-100 itself and 2^100 are taken as they are; more is refused.
  const std::string least = Write("least.off", file.replace(first, 24, "7.8886090522101181e-31 0 0 "));
  EXPECT_EQ(Call("detect " + least).err, "");
  file = Box(0, 0, 0, 1, false);
  Refuse("detect " + Write("large.off", file.replace(first, 5, "-1.3e30 0 0")), {"large.off", "vertex 0"});
}

TEST_F(Inputs, FieldMeshes) {
  const std::string field = TOPOADAPT_SHARED_DATA "/field/";
  if (!fs::exists(field + "concave_L.off")) GTEST_SKIP() << "no field data in " << field;
  struct Case {
    const char *name, *options;
    double volume;
  };
  for (const Case& c : {Case{"concave_L.off", "", 5}, Case{"concave_star.off", "", 4.25206},
                        Case{"insideout_box.off", " --turn", 1}, Case{"tinycoord.off", "", 1}}) {
    EXPECT_EQ(Call("detect " + field + c.name).out, "0 pairs\n") << c.name;
    const Ended run = Call("resolve " + field + c.name + c.options + " --out " + At("out.off"));
    EXPECT_EQ(run.exit_code, 0) << c.name << ": " << run.err;
    EXPECT_NEAR(TopologyOf(Read(At("out.off"))).Volume(), c.volume, 1e-5) << c.name;
  }
  Refuse("resolve " + field + "insideout_box.off --out " + At("never.off"), {"insideout_box.off", "--turn"});
  EXPECT_EQ(Lines(Call("detect " + field + "tinycoord.off").err), 1);
}

// ---------------------------------------------------------------- all commands

// A call of each command that ends at once, without options.
std::map<std::string, std::string> EveryCommand(const std::string& box, const std::string& out) {
  return {{"segment", "segment --phantom genus-3"},
          {"detect", "detect " + box},
          {"resolve", "resolve " + box + " --out " + out},
          {"validate", "validate " + box},
          {"evolve", "evolve meeting-4"},
          {"handles", "handles 5 4 3"}};
}

TEST_F(Inputs, EveryCommandTakesQuietAndJson) {
  const std::map<std::string, std::vector<std::string>> seconds = {
      {"segment", {"total", "detect", "adapt", "remesh", "evolve"}},
      {"detect", {"total", "detect"}},
      {"resolve", {"total", "adapt"}},
      {"validate", {"total", "detect"}},
      {"evolve", {"total", "detect", "adapt", "remesh", "evolve"}}};
  for (const auto& [name, call] : EveryCommand(Write("box.off", Box(0, 0, 0, 1, false)), At("out.off"))) {
    const Ended run = Call(call + " --quiet --json -");
    EXPECT_EQ(run.exit_code, 0) << name << ": " << run.err;
    EXPECT_EQ(run.err, "") << name;
    EXPECT_EQ(Lines(run.out), 1) << name;
    ExpectKeys(run.out, {"options"});
    EXPECT_NE(run.out.find("\"quiet\":true"), std::string::npos) << name << ": " << run.out;
    EXPECT_EQ(Call(call + " --json " + At("report.json")).exit_code, 0) << name;
    const std::string report = Contents(At("report.json"));
    ExpectKeys(report, {"options"});
    if (name == "handles") continue;
    ExpectKeys(report,
               {"vertices", "triangles", "components", "self_intersections", "seconds", "arena_bytes", "peak_bytes"});
    const size_t from = report.find("\"seconds\":{");
    const std::string times = report.substr(from, report.find('}', from) - from);
    for (const std::string& key : seconds.at(name))
      EXPECT_NE(times.find("\"" + key + "\":"), std::string::npos) << name << " lacks " << key << ": " << times;
  }
}

TEST_F(Inputs, EveryCommandHasHelp) {
  const std::vector<std::string> bounds = {"--max-vertices", "--max-bytes"};
  const std::map<std::string, std::vector<std::string>> options = {
      {"segment", {"--phantom", "--noise-seed", "--seed",  "--seed-mm", "--radius", "--threshold",  "--bright",
                   "--sigma",   "--edge",       "--width", "--tension", "--speed",  "--iterations", "--space",
                   "--partial", "--drop-below", "--genus", "--every",   "--frames", "--save",       "--resume",
                   "--out",     "--info",       "voxels",  "mm"}},
      {"detect",
       {"--mode", "--cell", "--pairs", "--turn", "--turn-parts", "--weld", "--fill", "--as-is", "unit", "seconds"}},
      {"resolve", {"--out", "--turn", "--turn-parts", "--weld", "--fill", "--as-is", "seconds"}},
      {"validate", {"--turn", "--turn-parts", "--weld", "--fill", "--as-is", "unit", "seconds"}},
      {"evolve",
       {"--list", "--seed", "--renumber", "--turn", "--steps", "--stride", "--no-substeps", "--out", "edge lengths"}},
      {"handles", {"--list"}}};
  for (const auto& [name, words] : options) {
    const Ended help = Call(name + " --help");
    EXPECT_EQ(help.exit_code, 0) << name;
    EXPECT_EQ(help.err, "") << name;
    std::vector<std::string> all = words;
    all.insert(all.end(), {"usage: topoadapt " + name, "--json", "--quiet"});
    if (name != "handles") all.insert(all.end(), bounds.begin(), bounds.end());
    for (const std::string& word : all) EXPECT_NE(help.out.find(word), std::string::npos) << name << " lacks " << word;
    EXPECT_EQ(Call(name + " anything --help --more").out, help.out);
  }
}

// The input does not exist, and yet the message is about the output.
TEST_F(Inputs, OutputsAndOptionsAreCheckedFirst) {
  const std::string report = " --json " + At("no/such/report.json");
  const std::string volume = "segment " + At("absent.nrrd") + " --seed 1,1,1 --threshold 1";
  for (const std::string& call :
       {"detect " + At("absent.off"), "validate " + At("absent.off"),
        "resolve " + At("absent.off") + " --out " + At("m.off"), volume, "segment --phantom absent" + std::string(),
        "evolve absent" + std::string(), "handles 5 99" + std::string()})
    Refuse(call + report, {"report.json", "no folder"});
  for (const std::string& call : {"resolve " + At("absent.off"), volume, "evolve absent" + std::string()}) {
    Refuse(call + " --out " + At("no/such/m.ply"), {"m.ply", "no folder"});
    Refuse(call + " --out " + At("m.doc"), {"m.doc", ".ply"});
    Refuse(call + " --out " + At("m.ply") + " --json " + At("m.ply"), {"--out", "--json", "m.ply"});
    fs::create_directories(At("folder.ply"));
    Refuse(call + " --out " + At("folder.ply"), {"folder.ply", "folder"});
    EXPECT_FALSE(fs::exists(At("m.ply")));
  }
  Refuse("detect " + At("absent.off") + " --mode sideways", {"--mode"});
  Refuse("detect " + At("absent.off") + " --cell -1", {"--cell"});
  Refuse("detect " + At("absent.off") + " --max-vertices 3", {"--max-vertices"});
  Refuse("resolve " + At("absent.off"), {"--out"});
  Refuse(volume + " --radius 0", {"--radius"});
  Refuse(volume + " --sigma -1", {"--sigma"});
  Refuse("evolve absent --turn 24", {"--turn"});
}

TEST_F(Inputs, StandardOutputIsTheReportsAlone) {
  const std::string box = Write("box.off", Box(0, 0, 0, 1, false));
  Refuse("detect " + box + " --pairs --json -", {"--pairs", "--json"});
  Refuse("handles 5 4 3 --list --json -", {"--list", "--json"});
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const Ended full = Call("detect " + box + " --json /dev/full");
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_EQ(Lines(full.err), 1) << full.err;
}

}  // namespace
}  // namespace inputs_test
