// SPDX-License-Identifier: MIT
// `topoadapt segment` as a process, on small volumes made here: what it fills, what it says, where the mesh lies.
#include <array>
#include <cmath>
#include <functional>

#include "support/tool_support.h"
#include "tool/io/files.h"

namespace segment_test {
namespace {

using namespace support;
namespace fs = std::filesystem;
using Segment = Tool;

using Grey = std::function<double(double, double, double)>;

// An attached NRRD of floats; `grey` of the voxel indices.
std::string Nrrd(int nx, int ny, int nz, const std::string& more, const Grey& grey) {
  std::ostringstream text;
  text << "NRRD0004\ntype: float\ndimension: 3\nsizes: " << nx << " " << ny << " " << nz
       << "\nendian: little\nencoding: raw\n"
       << more << "\n";
  std::string bytes = text.str();
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) tool::append_little_endian(bytes, static_cast<float>(grey(i, j, k)));
  return bytes;
}

double Ball(double i, double j, double k, double r) { return std::hypot(i, j, k) - r; }

// A bright ball, and a dimmer tube out of it along x.
double BallAndTube(double i, double j, double k, double radius, double dim) {
  if (Ball(i - 8, j - 8, k - 8, 6) < 0) return 250;
  return i > 8 && i < 38 && std::hypot(j - 8, k - 8) <= radius ? dim : 0;
}

Mesh Read(const std::string& path) {
  Mesh m;
  const tool::Status s = tool::read_mesh(path, m);
  EXPECT_TRUE(s.ok) << s.message;
  return m;
}

bool Has(const std::string& text, const std::string& word) { return text.find(word) != std::string::npos; }

// The number behind a key of a report.
double Number(const std::string& json, const std::string& key) {
  const size_t at = json.find("\"" + key + "\":");
  EXPECT_NE(at, std::string::npos) << key << ": " << json;
  return at == std::string::npos ? 0 : std::strtod(json.c_str() + at + key.size() + 3, nullptr);
}

TEST_F(Segment, FillsDimAndThinParts) {
  const std::string dim = Write(
      "dim.nrrd", Nrrd(44, 17, 17, "", [](double i, double j, double k) { return BallAndTube(i, j, k, 3, 120); }));
  const std::string thin = Write(
      "thin.nrrd", Nrrd(44, 17, 17, "", [](double i, double j, double k) { return BallAndTube(i, j, k, 1.5, 250); }));
  for (const std::string& volume : {dim, thin})
    for (const char* seed : {"8,8,8", "24,8,8"}) {
      const Ended run =
          Call("segment " + volume + " --seed " + seed + " --threshold 100 --bright --json - --out " + At("m.ply"));
      EXPECT_EQ(run.exit_code, 0) << volume << " " << seed << ": " << run.err;
      EXPECT_GE(Number(run.out, "share"), 0.95) << run.out;
      const Mesh m = Read(At("m.ply"));
      EXPECT_TRUE(IsSound(m, "ball and tube"));
      EXPECT_EQ(TopologyOf(m).Genera(), (std::vector<int64_t>{0}));
    }
}

TEST_F(Segment, ThreadsGiveTheSameBits) {
  const std::string volume = Write(
      "dim.nrrd", Nrrd(44, 17, 17, "", [](double i, double j, double k) { return BallAndTube(i, j, k, 2.5, 150); }));
  const std::string call =
      "segment " + volume + " --seed 8,8,8 --threshold 100 --sigma .6 --bright --iterations 40 --partial --out ";
  std::string one;
  for (const char* threads : {"1", "2", "3"}) {
    const Ended run = Call(call + At("m.ply") + " --threads " + threads);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    if (one.empty()) one = Contents(At("m.ply"));
    EXPECT_EQ(Contents(At("m.ply")), one) << threads;
  }
  for (const char* bad : {"0", "257", "-1", "two"}) Refuse(call + At("never.ply") + " --threads " + bad, {"--threads"});
}

// Balls without noise and with a soft border, whose chords leave out voxels that lie on the border.
TEST_F(Segment, SmoothBallsComeToRest) {
  const double radii[] = {3.5, 5, 6, 7, 8};
  for (const double r : radii) {
    const Grey soft = [&](double i, double j, double k) {
      return std::clamp(500 - 1000 / 3.0 * Ball(i - 13, j - 13, k - 13, r), 0.0, 1000.0);
    };
    const std::string volume = Write("ball.nrrd", Nrrd(27, 27, 27, "", soft));
    const Ended run =
        Call("segment " + volume + " --seed 13,13,13 --threshold 500 --bright --json - --out " + At("m.ply"));
    EXPECT_EQ(run.exit_code, 0) << r << ": " << run.err;
    EXPECT_TRUE(Has(run.out, "\"ended\":\"at rest\"")) << r;
    EXPECT_LT(Number(run.out, "iterations"), 100) << r;
    EXPECT_EQ(Has(run.err, "going on with edges down to"), !Has(run.out, "\"passes\":[]")) << run.err;
    const Mesh m = Read(At("m.ply"));
    const MeshOnFailure judged("soft ball", m);
    const double volume_of_ball = 4.0 / 3 * tool::pi * r * r * r;
    EXPECT_NEAR(TopologyOf(m).Volume(), volume_of_ball, 0.07 * volume_of_ball) << r;
    EXPECT_LT(m.positions.size() / 3, 2000u) << r;
  }
}

// A second pass that fills nothing ends the work: plates one voxel apart from each other, too thin for any edge.
TEST_F(Segment, PassesStopWhereTheyGainNothing) {
  const std::string volume = Write("comb.nrrd", Nrrd(40, 24, 24, "", [](double i, double j, double k) {
                                     const bool block = i >= 4 && i < 16, plate = i >= 16 && i < 36 && int(j) % 3 == 0;
                                     const bool within = j >= 3 && j < 21 && k >= 3 && k < 21;
                                     return within && (block || plate) ? 104 : 0;
                                   }));
  const Ended run =
      Call("segment " + volume + " --seed 10,12,12 --threshold 100 --bright --json - --out " + At("m.ply"));
  EXPECT_EQ(run.exit_code, 1) << run.out;
  EXPECT_TRUE(Has(run.out, "\"ended\":\"at rest\"")) << run.out;
  EXPECT_TRUE(Has(run.err, "going on with edges down to")) << run.err;
  const size_t passes = run.out.find("\"passes\":[{");
  ASSERT_NE(passes, std::string::npos) << run.out;
  EXPECT_LT(Number(run.out, "iterations"), 1000);
  EXPECT_LT(Number(run.out, "vertices"), 20000);
}

TEST_F(Segment, SaysWhatIsLeftOut) {
  const std::string volume = Write(
      "thin.nrrd", Nrrd(44, 17, 17, "", [](double i, double j, double k) { return BallAndTube(i, j, k, 1, 250); }));
  const std::string call = "segment " + volume +
                           " --seed 8,8,8 --threshold 100 --bright --radius 3 --edge 4 --edge-fine 4 --out " +
                           At("m.ply");
  const Ended run = Call(call);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_TRUE(Has(run.out, "filled ")) << run.out;
  for (const char* word : {"less than 95 %", "left out", "voxel ", ",8,8 ("})
    EXPECT_TRUE(Has(run.err, word)) << run.err;
  EXPECT_TRUE(fs::exists(At("m.ply")));
  const Ended partial = Call(call + " --partial --json -");
  EXPECT_EQ(partial.exit_code, 0) << partial.err;
  ExpectKeys(partial.out, {"fill", "objections", "ended", "space", "border", "first_balls"});
  EXPECT_LT(Number(partial.out, "share"), 0.95);
  EXPECT_EQ(Number(partial.out, "object_voxels"), 895 + 30 * 5 - 6 * 5) << "the ball's voxels and the tube's beyond";
}

TEST_F(Segment, NamesNeighbours) {
  // Two bars along z that touch in an edge: the interpolant connects them, faces of voxels do not.
  const std::string bars =
      Write("bars.nrrd", Nrrd(20, 20, 12, "", [](double i, double j, double k) {
              return i > 1 && i < 18 && j > 1 && j < 18 && k > 1 && k < 10 && (i < 10) == (j < 10) ? 250 : 0;
            }));
  const Ended leak = Call("segment " + bars + " --seed 5,5,5 --threshold 50 --bright --json -");
  EXPECT_EQ(leak.exit_code, 1);
  EXPECT_TRUE(Has(leak.err, "leaks into neighbours")) << leak.err;
  EXPECT_GT(Number(leak.out, "neighbour_voxels"), 100);
  // A first ball that reaches the neighbour, and one that reaches nothing but the dark.
  const std::string gap =
      Write("gap.nrrd", Nrrd(30, 20, 12, "", [](double i, double j, double k) {
              return i > 1 && i < 28 && k > 3 && k < 8 && ((j > 3 && j < 8) || (j > 9 && j < 15)) ? 250 : 0;
            }));
  Refuse("segment " + gap + " --seed 14,6,6 --threshold 100 --bright --radius 6", {"--radius", "another part"});
  const Ended wide = Call("segment " + gap + " --seed 14,6,6 --threshold 100 --bright --radius 3");
  EXPECT_EQ(wide.exit_code, 0) << wide.err;
  EXPECT_TRUE(Has(wide.err, "reaches outside")) << wide.err;
}

TEST_F(Segment, ThickSlicesGiveTheSameBall) {
  const double radius = 9;
  for (const auto& step : {std::array<double, 3>{1, 1, 1}, std::array<double, 3>{0.5, 0.5, 3}}) {
    std::ostringstream more;
    more << "spacings: " << step[0] << " " << step[1] << " " << step[2] << "\n";
    const int n[3] = {int(24 / step[0]), int(24 / step[1]), int(24 / step[2])};
    const std::string volume = Write(
        "ball.nrrd", Nrrd(n[0], n[1], n[2], more.str(), [&](double i, double j, double k) {
          // A border that partial volume blurs over a millimetre.
          return 100 - 100 * std::clamp(Ball(i * step[0] - 12, j * step[1] - 12, k * step[2] - 12, radius), -1.0, 1.0);
        }));
    const Ended run = Call("segment " + volume +
                           " --seed-mm 12,12,12 --threshold 100 --bright --radius 3 --json - --out " + At("m.ply"));
    EXPECT_EQ(run.exit_code, 0) << run.err;
    const Mesh m = Read(At("m.ply"));
    EXPECT_NEAR(TopologyOf(m).Volume() / (4.18879 * radius * radius * radius), 1, 0.05);
    EXPECT_NEAR(Number(run.out, "volume"), TopologyOf(m).Volume(), 1e-6 * TopologyOf(m).Volume());
    for (size_t p = 0; p < m.positions.size(); p += 3)
      EXPECT_NEAR(std::hypot(m.positions[p] - 12, m.positions[p + 1] - 12, m.positions[p + 2] - 12), radius, 1.2);
  }
}

TEST_F(Segment, MeshesLieInTheWorldThatIsNamed) {
  // Index (i, j, k) lies at (30 - i, -20 + 2 j, 5 + k) in LPS: mirrored.
  const std::string volume = Write(
      "m.nrrd", Nrrd(24, 12, 20,
                     "space: left-posterior-superior\nspace directions: (-1,0,0) (0,2,0) (0,0,1)\n"
                     "space origin: (30,-20,5)\n",
                     [](double i, double j, double k) { return Ball(i - 12, 2 * j - 11, k - 9, 6) < 0 ? 200 : 0; }));
  const std::string call = "segment " + volume + " --threshold 100 --bright --radius 2 ";
  const auto meshes = [&](const std::string& options) {
    const Ended run = Call(call + options + " --out " + At("m.ply") + " --json -");
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return Read(At("m.ply"));
  };
  const Mesh lps = meshes("--seed 12,5.5,9"), same = meshes("--seed-mm 18,-9,14"),
             ras = meshes("--seed 12,5.5,9 --space ras"), voxel = meshes("--seed 12,5.5,9 --space voxel");
  EXPECT_EQ(lps.positions, same.positions);
  ASSERT_EQ(lps.positions.size(), voxel.positions.size());
  for (size_t p = 0; p < lps.positions.size(); p += 3) {
    const double* v = &voxel.positions[p];
    EXPECT_NEAR(lps.positions[p], 30 - v[0], 1e-9);
    EXPECT_NEAR(lps.positions[p + 1], -20 + 2 * v[1], 1e-9);
    EXPECT_NEAR(lps.positions[p + 2], 5 + v[2], 1e-9);
    EXPECT_EQ(ras.positions[p], -lps.positions[p]);
    EXPECT_EQ(ras.positions[p + 1], -lps.positions[p + 1]);
    EXPECT_EQ(ras.positions[p + 2], lps.positions[p + 2]);
  }
  for (const Mesh* m : {&lps, &ras, &voxel}) EXPECT_TRUE(IsSound(*m, "ball"));
  EXPECT_GT(TopologyOf(lps).Volume(), 0);
  EXPECT_NEAR(TopologyOf(ras).Volume(), TopologyOf(lps).Volume(), 1e-9);
  EXPECT_NEAR(2 * TopologyOf(voxel).Volume(), TopologyOf(lps).Volume(), 1e-9);
  const std::string plain = Write("p.nrrd", Nrrd(12, 12, 12, "", [](double i, double j, double k) {
                                    return Ball(i - 6, j - 6, k - 6, 4) < 0 ? 200 : 0;
                                  }));
  Refuse("segment " + plain + " --seed 6,6,6 --threshold 100 --bright --space ras", {"--space", "p.nrrd"});
}

TEST_F(Segment, SeveralSeedsAndSmallParts) {
  const std::string volume =
      Write("two.nrrd", Nrrd(40, 16, 16, "", [](double i, double j, double k) {
              return Ball(i - 8, j - 8, k - 8, 6) < 0 || Ball(i - 30, j - 8, k - 8, 4) < 0 ? 200 : 0;
            }));
  const std::string call =
      "segment " + volume + " --threshold 100 --bright --seed 8,8,8 --seed-mm 30,8,8 --out " + At("m.ply");
  EXPECT_EQ(Call(call + " --genus 0").exit_code, 0);
  EXPECT_EQ(TopologyOf(Read(At("m.ply"))).Genera(), (std::vector<int64_t>{0, 0}));
  const Ended genus = Call(call + " --genus 1");
  EXPECT_EQ(genus.exit_code, 1);
  EXPECT_TRUE(Has(genus.err, "genus is 0, not 1")) << genus.err;
  const Ended dropped = Call(call + " --drop-below 400 --partial --json -");
  EXPECT_EQ(dropped.exit_code, 0) << dropped.err;
  EXPECT_EQ(Number(dropped.out, "dropped_components"), 1);
  EXPECT_EQ(TopologyOf(Read(At("m.ply"))).Genera(), (std::vector<int64_t>{0}));
  // Two seeds in one part: their balls overlap.
  EXPECT_EQ(Call("segment " + volume + " --threshold 100 --bright --radius 2 --seed 8,8,8 --seed 9.5,8,8 --genus 0")
                .exit_code,
            0);
}

std::string BallVolume(int n) {
  return Nrrd(n, n, n, "", [n](double i, double j, double k) {
    return Ball(i - 0.5 * n, j - 0.5 * n, k - 0.5 * n, 0.4 * n) < 0 ? 200 : 0;
  });
}

TEST_F(Segment, GoesOnFromASavedState) {
  const std::string volume = Write("ball.nrrd", BallVolume(24));
  const std::string call =
      "segment " + volume + " --seed 12,12,12 --radius 2 --threshold 100 --bright --partial --out ";
  EXPECT_EQ(Call(call + At("whole.ply")).exit_code, 0);
  const Ended early = Call(call.substr(0, call.find("--partial")) + "--iterations 7");
  EXPECT_EQ(early.exit_code, 1);
  EXPECT_TRUE(Has(early.err, "--iterations 7")) << early.err;
  const Ended first = Call(call + At("first.ply") + " --iterations 7 --save " + At("state") + " --json -");
  EXPECT_EQ(first.exit_code, 0) << first.err;
  EXPECT_EQ(Number(first.out, "iterations"), 7);
  EXPECT_TRUE(Has(first.out, "\"ended\":\"iterations\"")) << first.out;
  EXPECT_EQ(Call(call + At("second.ply") + " --resume " + At("state")).exit_code, 0);
  EXPECT_NE(Contents(At("first.ply")), Contents(At("whole.ply")));
  EXPECT_EQ(Contents(At("second.ply")), Contents(At("whole.ply")));
  const std::string state = Contents(At("state"));
  for (const size_t size : {size_t{0}, size_t{9}, size_t{60}, state.size() / 2, state.size() - 1}) {
    Write("cut", state.substr(0, size));
    if (size > 0) Refuse(call + At("never.ply") + " --resume " + At("cut"), {"saved state"});
  }
  // Each part: mark, hashes, iterations, particles, places, the library's bytes.
  for (const size_t at : {size_t{3}, size_t{22}, size_t{30}, size_t{45}, size_t{60}, size_t{91}, state.size() / 4,
                          state.size() / 2, state.size() - 9, state.size() - 1}) {
    std::string flipped = state;
    flipped[at] = static_cast<char>(flipped[at] ^ 4);
    Write("flipped", flipped);
    Refuse(call + At("never.ply") + " --resume " + At("flipped"), {"saved state is damaged"});
  }
  for (const char* other : {"--speed 0.3", "--tension 0.2", "--sigma 0.5", "--edge 2"})
    Refuse(call + At("never.ply") + " " + other + " --resume " + At("state"), {"saved state", "other options"});
  EXPECT_FALSE(fs::exists(At("never.ply")));
}

TEST_F(Segment, FramesLimitsAndInterrupts) {
  const std::string volume = Write("ball.nrrd", BallVolume(32));
  const std::string call =
      "segment " + volume + " --seed 16,16,16 --radius 3 --threshold 100 --bright --out " + At("m.ply");
  fs::create_directories(At("frames"));
  EXPECT_EQ(Call(call + " --every 3 --frames " + At("frames")).exit_code, 0);
  EXPECT_TRUE(fs::exists(At("frames/frame-000003.ply")));
  EXPECT_TRUE(fs::exists(At("frames/frame-000006.ply")));
  EXPECT_FALSE(fs::exists(At("frames/frame-000004.ply")));
  EXPECT_TRUE(IsSound(Read(At("frames/frame-000006.ply")), "frame"));
  const Ended limit = Call(call + " --edge 1 --max-vertices 1500 --json -");
  EXPECT_EQ(limit.exit_code, 2) << "the object takes more: " << limit.err;
  const Ended late = Call(call + " --edge 1.5 --max-vertices 1050 --json -");
  EXPECT_EQ(late.exit_code, 1) << late.err;
  EXPECT_TRUE(Has(late.out, "\"ended\":\"limit\"")) << late.out;
  EXPECT_TRUE(IsSound(Read(At("m.ply")), "as far as the balloon came"));
  // A mesh at rest, and none finer for want of vertices.
  const std::string thin = Write(
      "thin.nrrd", Nrrd(44, 17, 17, "", [](double i, double j, double k) { return BallAndTube(i, j, k, 1, 250); }));
  const std::string second =
      "segment " + thin + " --seed 8,8,8 --radius 3 --threshold 100 --bright --edge 6 --json - --out " + At("m.ply");
  const double finest = Number(Call(second).out, "vertices");
  const double coarse = Number(Call(second + " --partial --edge-fine 2.4").out, "vertices");
  ASSERT_GT(finest, 2 * coarse);
  for (const double more : {1., 10., 100.}) {
    fs::remove(At("m.ply"));
    const Ended cut = Call(second + " --max-vertices " + std::to_string(int(coarse + more)));
    EXPECT_EQ(cut.exit_code, 1) << cut.err;
    EXPECT_TRUE(Has(cut.out, "\"ended\":\"limit\"")) << cut.out;
    EXPECT_GE(Number(cut.out, "share"), 0.8);
    EXPECT_TRUE(IsSound(Read(At("m.ply")), "at rest once"));
  }
  fs::remove(At("m.ply"));
  // Interrupted as Ctrl-C does, once the balloon is at work.
  fs::create_directories(At("first"));
  const std::string slow = std::string("\"") + TOPOADAPT_TOOL_PATH +
                           "\" segment --phantom cube-cavity --edge 0.6 --quiet --every 1 --frames \"" + At("first") +
                           "\" --out \"" + At("m.ply") + "\" --json \"" + At("r.json") +
                           "\" > /dev/null 2>&1 & tool=$!; while [ ! -e \"" + At("first/frame-000001.ply") +
                           "\" ] && kill -0 $tool; do sleep 0.01; done 2> /dev/null; kill -INT $tool; wait $tool";
  const int status = std::system(slow.c_str());
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 1);
  EXPECT_TRUE(Has(Contents(At("r.json")), "\"ended\":\"interrupted\"")) << Contents(At("r.json"));
  EXPECT_TRUE(IsSound(Read(At("m.ply")), "interrupted"));
}

// Nothing that an option says ends in an abort, or takes more memory than there is.
TEST_F(Segment, NoOptionAborts) {
  const std::string volume = Write("ball.nrrd", BallVolume(16));
  const std::string seed = "--seed 8,8,8 --threshold 100 --bright ";
  const std::string tool = WithinMemory(3000) + "segment " + volume + " ";
  const auto call = [&](const std::string& options) {
    const int status = std::system((tool + options + " --quiet > \"" + At("o") + "\" 2> \"" + At("e") + "\"").c_str());
    EXPECT_TRUE(WIFEXITED(status)) << options;
    EXPECT_LE(WEXITSTATUS(status), 2) << options << ": " << Contents(At("e"));
    return Contents(At("e"));
  };
  for (const char* word : {"--radius", "volume"}) EXPECT_TRUE(Has(call(seed + "--radius 5000"), word));
  for (const char* length : {"1e6", "1e300"}) EXPECT_TRUE(Has(call(seed + "--edge " + length), "diagonal"));
  EXPECT_TRUE(Has(call(seed + "--edge 1e-5"), "--edge"));
  // Six gigabytes of arena, and no bound for it under sanitizers.
  if (!TOPOADAPT_SANITIZED) {
    EXPECT_TRUE(Has(call(seed + "--edge 0.004"), "--edge"));
  }
  // A first ball of more vertices than the first block takes.
  EXPECT_FALSE(Has(call(seed + "--edge 0.08 --iterations 1"), "limit"));
  EXPECT_TRUE(Has(call(seed + "--sigma 1e9"), "sigma"));
  EXPECT_TRUE(Has(call(seed + "--edge-fine 1e-9"), "--edge / 255"));
  for (const char* option :
       {"--radius 1e-9", "--radius 1e300", "--edge 27", "--edge 1e-300", "--sigma 100", "--width 1e-300",
        "--width 1e300", "--tension 1 --iterations 50", "--tension 0 --iterations 50", "--speed 1e300 --iterations 50",
        "--speed 1e-300 --iterations 50", "--iterations 0", "--edge-fine 0.01 --iterations 20", "--drop-below 1e300",
        "--genus 7", "--max-bytes 1", "--max-vertices 4", "--seed 8,8,8"})
    call(seed + option);
  call("--seed 8,8,8 --threshold -1e300 --bright");
  call("--seed 8,8,8 --threshold 199.999 --bright");
  call("--seed-mm 1e300,0,0 --threshold 100 --bright");
}

}  // namespace
}  // namespace segment_test
