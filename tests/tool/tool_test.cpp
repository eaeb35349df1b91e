// SPDX-License-Identifier: MIT
// The tool: exit codes, one line on stderr for each bad input, and machine-readable reports.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <set>
#include <sstream>

#include "support/tool_support.h"

namespace tool_test {
namespace {

using namespace support;
namespace fs = std::filesystem;

// ---------------------------------------------------------------- commands and options

TEST_F(Tool, SaysWhatItIs) {
  const Ended version = Call("--version");
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_EQ(version.out.rfind("topoadapt ", 0), 0u) << version.out;
  const Ended help = Call("--help");
  EXPECT_EQ(help.exit_code, 0);
  for (const char* command : {"segment", "detect", "resolve", "validate", "evolve", "handles"})
    EXPECT_NE(help.out.find(command), std::string::npos) << command;
  EXPECT_EQ(Call("").exit_code, 2);
}

TEST_F(Tool, RefusesUnknownCommandsAndOptions) {
  Refuse("frobnicate", {"frobnicate"});
  Refuse("validate --frobnicate x.off", {"--frobnicate"});
  Refuse("validate", {"MESH"});
  Refuse("validate a.off b.off", {"MESH"});
  Refuse("detect " + Write("s.off", Sphere({0, 0, 0}, 1, 3)) + " --mode sideways", {"--mode"});
  Refuse("resolve " + At("s.off"), {"--out"});
  Refuse("segment", {"VOLUME"});
  Refuse("segment --phantom nothing", {"nothing"});
  Refuse("segment --phantom cyst --radius", {"--radius"});
  Refuse("segment --phantom cyst --radius 0", {"--radius"});
  Refuse("segment --phantom cyst --radius many", {"--radius", "many"});
  Refuse("segment --phantom cyst --seed 1,2", {"--seed"});
  Refuse("evolve", {"SCENE"});
  Refuse("evolve nothing", {"nothing", "--list"});
  Refuse("evolve ring ring", {"SCENE"});
  Refuse("evolve --list ring", {"--list"});
  Refuse("evolve ring --seed one", {"--seed", "one"});
  Refuse("evolve ring --stride -1", {"--stride"});
  Refuse("evolve ring --turn 24", {"--turn"});
  Refuse("handles 5", {});
  Refuse("handles 5 4 3 3 3", {});
  Refuse("handles 5 2", {"2"});
  Refuse("handles 5 16", {"15", "16"});
  Refuse("handles 5 four", {"four"});
}

// ---------------------------------------------------------------- handles

using Face = std::array<int, 3>;
using Handle = std::set<Face>;

// Up to the order of the faces, and the direction of listing.
Handle HandleOf(const std::string& line) {
  Handle faces;
  std::istringstream text(line);
  std::string word;
  while (text >> word) {
    Face f{};
    if (std::sscanf(word.c_str(), "(%d,%d,%d)", &f[0], &f[1], &f[2]) != 3) continue;
    std::sort(f.begin(), f.end());
    faces.insert(f);
  }
  return faces;
}

TEST_F(Tool, ListsTheHandlesOfThePaper) {
  const Ended run = Call("handles 5 4 3 --list");
  EXPECT_EQ(run.exit_code, 0);
  std::istringstream text(run.out);
  std::set<Handle> handles;
  int lines = 0;
  for (std::string line; std::getline(text, line); ++lines) {
    const Handle h = HandleOf(line);
    EXPECT_EQ(h.size(), 14u) << line;
    handles.insert(h);
  }
  EXPECT_EQ(lines, 120);
  EXPECT_EQ(handles.size(), 120u);
  // Section 4.2: the printed example, and its image under a rotation of the first polygon.
  EXPECT_EQ(handles.count(HandleOf("(1,2,11) (1,5,12) (1,11,12) (2,3,8) (2,8,10) (2,10,11) (3,4,7) (3,7,8) (4,5,6) "
                                   "(4,6,7) (5,6,9) (5,9,12) (8,9,10) (9,10,12)")),
            1u);
  EXPECT_EQ(handles.count(HandleOf("(5,1,11) (5,4,12) (5,11,12) (1,2,8) (1,8,10) (1,10,11) (2,3,7) (2,7,8) (3,4,6) "
                                   "(3,6,7) (4,6,9) (4,9,12) (8,9,10) (9,10,12)")),
            1u);
}

TEST_F(Tool, ReportsHandlesAsJson) {
  const Ended run = Call("handles 5 4 3 --json -");
  EXPECT_EQ(run.exit_code, 0);
  ExpectKeys(run.out, {"k", "sides", "handles", "generators", "faces"});
  EXPECT_NE(run.out.find("\"handles\":120"), std::string::npos) << run.out;
  EXPECT_NE(run.out.find("\"faces\":14"), std::string::npos) << run.out;
  EXPECT_EQ(Call("handles 4 3 --json " + At("h.json")).exit_code, 0);
  ExpectKeys(Contents(At("h.json")), {"handles"});
}

// ---------------------------------------------------------------- meshes

// By the table of RFC 3629, byte by byte.
bool IsUtf8(const std::string& text) {
  for (size_t i = 0; i < text.size();) {
    uint32_t code = static_cast<unsigned char>(text[i++]);
    if (code < 0x80) continue;
    const int more = code >> 5 == 6 ? 1 : code >> 4 == 14 ? 2 : code >> 3 == 30 ? 3 : 0;
    if (more == 0) return false;
    code &= 0x3Fu >> more;
    for (int k = 0; k < more; ++k, ++i) {
      if (i >= text.size() || (static_cast<unsigned char>(text[i]) >> 6) != 2) return false;
      code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3Fu);
    }
    const uint32_t least = more == 1 ? 0x80 : more == 2 ? 0x800 : 0x10000;
    if (code < least || code > 0x10FFFF || (code >= 0xD800 && code < 0xE000)) return false;
  }
  return true;
}

TEST_F(Tool, ValidatesDetectsAndResolves) {
  const std::string clean = Write("clean.ply", Torus({0, 0, 0}, 3, 1, 20, 10));
  const std::string tangled = Write("tangled.off", Together({Sphere({0, 0, 0}, 1, 6), Sphere({0.9, 0.1, 0.2}, 1, 6)}));
  EXPECT_EQ(Call("validate " + clean).exit_code, 0);
  EXPECT_EQ(Call("detect " + clean).exit_code, 0);
  EXPECT_EQ(Call("validate " + tangled).exit_code, 1);
  EXPECT_EQ(Call("detect " + tangled).exit_code, 1);
  EXPECT_EQ(Call("detect " + tangled + " --mode vertex-hash --cell 0.5").exit_code, 1);

  tool::TriangleMesh m;
  ASSERT_TRUE(tool::read_mesh(tangled, m).ok);
  const Pairs expected = AllMeetingPairs(m);
  std::istringstream pairs(Call("detect " + tangled + " --pairs").out);
  Pairs listed;
  for (uint32_t a, b; pairs >> a >> b;) listed.emplace_back(a, b);
  EXPECT_EQ(listed, expected);

  const Ended resolved = Call("resolve " + tangled + " --out " + At("out.ply") + " --json -");
  EXPECT_EQ(resolved.exit_code, 0) << resolved.err;
  ExpectKeys(resolved.out,
             {"vertices", "triangles", "components", "self_intersections", "handles", "arena_bytes", "peak_bytes"});
  ASSERT_TRUE(tool::read_mesh(At("out.ply"), m).ok);
  const MeshOnFailure judged("resolved", m);
  EXPECT_TRUE(IsSound(m, "resolved"));
  EXPECT_EQ(TopologyOf(m).Genera(), (std::vector<int64_t>{0}));

  const Ended report = Call("validate " + clean + " --json -");
  ExpectKeys(report.out, {"vertices", "triangles", "components", "self_intersections"});
  EXPECT_NE(report.out.find("\"self_intersections\":0"), std::string::npos) << report.out;
  ExpectKeys(Call("detect " + tangled + " --json -").out,
             {"vertices", "triangles", "components", "self_intersections", "arena_bytes", "peak_bytes"});
}

TEST_F(Tool, EvolvesAScene) {
  const Ended list = Call("evolve --list");
  EXPECT_EQ(list.exit_code, 0);
  for (const char* name : {"merging-pair", "balls-8", "dumbbell", "enright"})
    EXPECT_NE(list.out.find(std::string(name) + " "), std::string::npos) << name;
  const Ended run = Call("evolve meeting-4 --seed 1 --out " + At("four.ply") + " --json -");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  ExpectKeys(run.out, {"vertices", "triangles", "components", "self_intersections", "iterations", "events", "handles",
                       "seconds", "arena_bytes", "peak_bytes"});
  tool::TriangleMesh m;
  ASSERT_TRUE(tool::read_mesh(At("four.ply"), m).ok);
  const MeshOnFailure judged("evolved", m);
  EXPECT_TRUE(IsSound(m, "four"));
  EXPECT_EQ(TopologyOf(m).Genera(), (std::vector<int64_t>{0}));
  // Another seed gives another scene; the same seed gives the same bits.
  EXPECT_EQ(Call("evolve meeting-4 --seed 2 --out " + At("other.ply")).exit_code, 0);
  EXPECT_EQ(Call("evolve meeting-4 --seed 1 --out " + At("again.ply")).exit_code, 0);
  EXPECT_NE(Contents(At("four.ply")), Contents(At("other.ply")));
  EXPECT_EQ(Contents(At("four.ply")), Contents(At("again.ply")));
  // Stopped early, the scene misses its expected end.
  EXPECT_EQ(Call("evolve merging-pair --steps 1").exit_code, 1);
}

// Reports begin with version and build, and are JSON whatever the name of the file.
TEST_F(Tool, ReportsAreJsonForAnyName) {
  const std::string version = Call("--version").out, number = version.substr(10, version.find(',') - 10);
  for (const std::string name :
       {"plain", "\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80", "latin-\xE4", "\xC3", "\xC0\xAF", "\xED\xA0\x80",
        "\xF5\x80\x80\x80", "\xE2\x82", "tab\tand\"quote", "back\\slash", "\x01"}) {
    const std::string path = At(name + ".off");
    ASSERT_TRUE(tool::write_mesh(path, Sphere({0, 0, 0}, 1, 3)).ok);
    std::string quoted = "'" + path + "'";
    ASSERT_EQ(Call("detect --json " + At("r.json") + " " + quoted).exit_code, 0) << name;
    const std::string report = Contents(At("r.json"));
    ExpectKeys(report, {"version", "build", "vertices", "options"});
    EXPECT_EQ(report.find("birth"), std::string::npos);
    EXPECT_NE(report.find("\"version\":\"" + number + "\""), std::string::npos) << report;
    EXPECT_TRUE(IsUtf8(report)) << report;
  }
  EXPECT_NE(Contents(At("r.json")).find("\\u0001"), std::string::npos);
  Call("detect --json " + At("r.json") + " '" + At("latin-\xE4.off") + "'");
  EXPECT_NE(Contents(At("r.json")).find("latin-\\\\xe4.off"), std::string::npos) << Contents(At("r.json"));
}

TEST_F(Tool, OneIsNoPlural) {
  EXPECT_EQ(Call("validate " + Write("s.off", Sphere({0, 0, 0}, 1, 3))).out,
            "1 component, genus 0, 0 self-intersections\n");
  EXPECT_NE(Call("evolve merging-pair --steps 1").out.find("1 step, "), std::string::npos);
}

TEST_F(Tool, RefusesBadMeshesByElement) {
  const Mesh sphere = Sphere({0, 0, 0}, 1, 3);
  const auto refuse = [&](const std::string& name, const Mesh& m, const std::vector<std::string>& words) {
    const std::string path = Write(name + ".obj", m);
    for (const std::string& command :
         {"validate " + path, "detect " + path, "resolve " + path + " --out " + At("never.ply")}) {
      std::vector<std::string> all = words;
      all.push_back(name);
      Refuse(command, all);
    }
    EXPECT_FALSE(fs::exists(At("never.ply")));
  };
  Mesh m = sphere;
  m.triangles.resize(m.triangles.size() - 3);
  const std::string open = Write("open.obj", m);
  Refuse("validate " + open, {"open.obj", "1 hole", "3 edges"});
  Refuse("resolve " + open + " --out " + At("never.ply"), {"open.obj", "1 hole", "3 edges"});
  EXPECT_EQ(Call("detect " + open).out, "0 pairs\n");
  m = sphere;
  m.positions[3 * 4] = 1e40;
  refuse("magnitude", m, {"vertex 5", "2^100"});  // .obj counts from 1

  Refuse("validate " + At("absent.off"), {"absent.off"});
  Refuse("validate " + Write("mesh.xyz", std::string("1 2 3\n")), {"mesh.xyz", ".off"});
  Refuse("validate " + Write("empty.ply", std::string()), {"empty.ply"});
  Refuse("validate " + Write("index.off", std::string("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n"
                                                      "3 1 2 9\n3 0 3 2\n")),
         {"index.off", "9"});
  Refuse("validate " + Write("nan.off", std::string("OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 nan 1\n3 0 2 1\n3 0 1 3\n"
                                                    "3 1 2 3\n3 0 3 2\n")),
         {"nan.off", "3"});
  const std::string ply = Contents(Write("whole.ply", sphere));
  Refuse("validate " + Write("cut.ply", ply.substr(0, ply.size() / 2)), {"cut.ply"});
  const std::string good = Write("good.off", sphere);
  const Ended unwritable = Call("validate " + good + " --json " + At("no/such/folder.json"));
  EXPECT_EQ(unwritable.exit_code, 2);
  EXPECT_NE(unwritable.err.find("folder.json"), std::string::npos) << unwritable.err;
}

// ---------------------------------------------------------------- volumes

std::string NrrdHeader(int n) {
  const std::string size = std::to_string(n);
  return "NRRD0004\ntype: unsigned char\ndimension: 3\nsizes: " + size + " " + size + " " + size +
         "\nencoding: raw\n\n";
}

// A dark ball in a bright cube.
std::string BallVoxels(int n) {
  std::string voxels;
  const double c = 0.5 * (n - 1);
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) voxels += std::hypot(x - c, y - c, z - c) < 0.3 * n ? '\0' : '\xFF';
  return voxels;
}

TEST_F(Tool, SegmentsABallAndReports) {
  const std::string ball = Write("ball.nrrd", NrrdHeader(24) + BallVoxels(24));
  const Ended run = Call("segment " + ball + " --seed 11.5,11.5,11.5 --radius 3 --threshold 128 --quiet --out " +
                         At("ball.ply") + " --json -");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(run.err, "");
  ExpectKeys(run.out, {"vertices", "triangles", "components", "self_intersections", "iterations", "events", "handles",
                       "seconds", "arena_bytes", "peak_bytes"});
  for (const char* key : {"merge", "split", "genus_up", "genus_down", "death", "rollback", "k2", "k3", "k4", "more",
                          "total", "detect", "adapt", "remesh", "evolve"})
    EXPECT_NE(run.out.find("\"" + std::string(key) + "\":"), std::string::npos) << "lacks " << key << ": " << run.out;
  tool::TriangleMesh m;
  ASSERT_TRUE(tool::read_mesh(At("ball.ply"), m).ok);
  const MeshOnFailure judged("segmented", m);
  EXPECT_TRUE(IsSound(m, "ball"));
  EXPECT_EQ(TopologyOf(m).Genera(), (std::vector<int64_t>{0}));
  EXPECT_NEAR(TopologyOf(m).Volume(), 4.18879 * std::pow(0.3 * 24, 3), 300);
}

TEST_F(Tool, RefusesBadVolumesAndSeeds) {
  const std::string rest = " --seed 11.5,11.5,11.5 --threshold 128 --quiet";
  const std::string header = NrrdHeader(24), voxels = BallVoxels(24);
  const std::string ball = Write("ball.nrrd", header + voxels);
  Refuse("segment " + At("absent.nrrd") + rest, {"absent.nrrd"});
  Refuse("segment " + Write("volume.tiff", std::string("II*")) + rest, {"volume.tiff", ".nrrd"});
  Refuse("segment " + Write("short.nrrd", header + voxels.substr(0, 5000)) + rest, {"short.nrrd"});
  Refuse("segment " + Write("liar.nrrd", NrrdHeader(2000) + voxels) + rest, {"liar.nrrd"});
  Refuse("segment " + Write("overflow.nrrd", NrrdHeader(2000000000) + voxels) + rest, {"overflow.nrrd"});
  Refuse("segment " + Write("text.nrrd", std::string("not a volume\n")) + rest, {"text.nrrd"});
  Refuse("segment " + ball + " --seed 100,11,11 --threshold 128", {"seed"});
  Refuse("segment " + ball + " --seed -3,11,11 --threshold 128", {"seed"});
  Refuse("segment " + ball + " --seed nan,11,11 --threshold 128", {"seed"});
  Refuse("segment " + ball + " --seed 1,1,1 --radius 1 --threshold 128", {"seed"});         // bright at the seed
  Refuse("segment " + ball + " --seed 11.5,11.5,11.5 --threshold 128 --bright", {"seed"});  // dark at the seed
  Refuse("segment " + ball + " --threshold 128", {"--seed"});
  Refuse("segment " + ball + " --seed 1,1,1", {"--threshold"});
  Refuse("segment " + ball + rest + " --noise-seed 3", {"--noise-seed"});
  EXPECT_FALSE(fs::exists(At("never.ply")));
}

}  // namespace
}  // namespace tool_test
