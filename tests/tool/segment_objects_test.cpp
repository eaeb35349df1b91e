// SPDX-License-Identifier: MIT
// `topoadapt segment` on other objects than those beyond a threshold, and from other first surfaces than balls.
#include <array>
#include <cmath>
#include <functional>
#include <random>

#include "support/tool_support.h"
#include "tool/io/files.h"
#include "tool/segment/filling.h"
#include "tool/segment/mask_surface.h"
#include "tool/segment/selection.h"

namespace segment_objects_test {
namespace {

using namespace support;
using SegmentObjects = Tool;

using Grey = std::function<double(int, int, int)>;

std::string Nrrd(int n, const Grey& grey) {
  std::string bytes = "NRRD0004\ntype: float\ndimension: 3\nsizes: " + std::to_string(n) + " " + std::to_string(n) +
                      " " + std::to_string(n) + "\nendian: little\nencoding: raw\n\n";
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) tool::append_little_endian(bytes, static_cast<float>(grey(i, j, k)));
  return bytes;
}

// Distance from the circle of radius 7 about (11, 11, 11), in the plane of i and j.
double FromRing(int i, int j, int k) { return std::hypot(std::hypot(i - 11, j - 11) - 7, k - 11); }

// Label 3 is a ring, 7 two cubes.
double Labels(int i, int j, int k) {
  if (FromRing(i, j, k) < 2.6) return 3;
  const bool cubes = (i < 5 || i > 17) && j > 1 && j < 6 && k > 1 && k < 6 && i > 1 && i < 21;
  return cubes ? 7 : 0;
}

Mesh Read(const std::string& path) {
  Mesh m;
  const tool::Status s = tool::read_mesh(path, m);
  EXPECT_TRUE(s.ok) << s.message;
  return m;
}

using tool::operator-;

// Does the segment pq pass through the triangle, in general position? By signs of volumes.
bool Pierces(const tool::Point& p, const tool::Point& q, const tool::Point& a, const tool::Point& b,
             const tool::Point& c) {
  const auto side = [](const tool::Point& o, const tool::Point& x, const tool::Point& y, const tool::Point& z) {
    return tool::dot(x - o, tool::cross(y - o, z - o)) > 0;
  };
  if (side(p, a, b, c) == side(q, a, b, c)) return false;
  return side(p, q, a, b) == side(p, q, b, c) && side(p, q, b, c) == side(p, q, c, a);
}

std::vector<int64_t> Genera(const Mesh& m) {
  std::vector<int64_t> genera = TopologyOf(m).Genera();
  std::sort(genera.begin(), genera.end());
  return genera;
}

bool Has(const std::string& text, const std::string& word) { return text.find(word) != std::string::npos; }

TEST(MaskSurface, IsClosedSoundAndHoldsTheMask) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    tool::Volume grid;
    grid.nx = 4, grid.ny = 5, grid.nz = 3;
    grid.values.assign(60, 0);
    grid.to_world.axes[0] = {0.5, 0.1, 0};
    grid.to_world.axes[2] = {0, 0.2, seed % 2 == 0 ? 2.0 : -2.0};
    std::vector<uint8_t> mask(60);
    for (uint8_t& inside : mask) inside = random() % 100 < 10 + seed ? 1 : 0;
    const Mesh m = tool::mask_surface(grid, mask);
    EXPECT_TRUE(IsSound(m, "seed " + std::to_string(seed)));
    EXPECT_EQ(tool::enclosed_voxels(grid, m), mask) << seed;
  }
}

TEST_F(SegmentObjects, LabelsOneByOne) {
  const std::string map = Write("labels.nrrd", Nrrd(23, Labels));
  const Ended ring = Call("segment " + map + " --label 3 --genus 1 --out " + At("ring.ply"));
  EXPECT_EQ(ring.exit_code, 0) << ring.err;
  EXPECT_EQ(Genera(Read(At("ring.ply"))), (std::vector<int64_t>{1}));
  // Both pieces, without seeds; the one with the seed, with one.
  EXPECT_EQ(Call("segment " + map + " --label 7 --out " + At("cubes.ply")).exit_code, 0);
  EXPECT_EQ(Genera(Read(At("cubes.ply"))), (std::vector<int64_t>{0, 0}));
  EXPECT_EQ(Call("segment " + map + " --label 7 --seed 3,3,3 --radius 1 --out " + At("cube.ply")).exit_code, 0);
  EXPECT_EQ(Genera(Read(At("cube.ply"))), (std::vector<int64_t>{0}));
  Refuse("segment " + map + " --label 4", {"--label 4", "no voxel has this value"});
  Refuse("segment " + map + " --label 3 --threshold 1 --seed 1,1,1", {"is enough"});
}

TEST_F(SegmentObjects, AllLabels) {
  const std::string map = Write("labels.nrrd", Nrrd(23, Labels));
  const Ended run = Call("segment " + map + " --all-labels --json - --mask " + At("mask.nrrd") + " --out '" +
                         At("part-%d.ply") + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(Has(run.out, "\"label\":3") && Has(run.out, "\"label\":7")) << run.out;
  EXPECT_EQ(Genera(Read(At("part-3.ply"))), (std::vector<int64_t>{1}));
  EXPECT_EQ(Genera(Read(At("part-7.ply"))), (std::vector<int64_t>{0, 0}));
  EXPECT_EQ(Call("segment " + map + " --all-labels --out " + At("all.ply")).exit_code, 0);
  EXPECT_EQ(Genera(Read(At("all.ply"))), (std::vector<int64_t>{0, 0, 1}));
  EXPECT_TRUE(Has(Contents(At("all.ply")), "property int label\n"));
  // The mask is a label map again, of nearly the same voxels.
  const Ended again = Call("segment " + At("mask.nrrd") + " --label 3 --genus 1");
  EXPECT_EQ(again.exit_code, 0) << again.err;
  Refuse("segment " + map + " --all-labels --seed 1,1,1", {"--all-labels"});
  Refuse("segment " + map + " --all-labels --save " + At("s"), {"--save", "--all-labels"});
  const std::string grey = Write("grey.nrrd", Nrrd(5, [](int i, int, int) { return 0.5 * i; }));
  Refuse("segment " + grey + " --all-labels", {"no label map", "0.5"});
}

// Two halves of a cube with a common slanted wall, and a cube apart. The pairs are counted by trying all triangles of
// doubles on either side of the wall.
TEST_F(SegmentObjects, CrossingsOfNeighboursAreCounted) {
  const auto halves = [](int i, int j, int k) {
    const bool within = std::min({i, j, k}) >= 3 && j < 11 && k < 11;
    return !within ? 0 : 2 * i + j < 24 ? 1 : i < 15 ? 2 : i >= 18 && i < 22 ? 5 : 0;
  };
  const std::string map = Write("halves.nrrd", Nrrd(25, halves));
  const Ended run = Call("segment " + map + " --all-labels --out '" + At("m-%d.ply") + "'");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const Mesh one = Read(At("m-1.ply")), two = Read(At("m-2.ply"));
  uint64_t pairs = 0;
  const auto corner = [](const Mesh& m, size_t t, size_t c) {
    const double* p = &m.positions[3 * size_t{m.triangles[t + c]}];
    return tool::Point{p[0], p[1], p[2]};
  };
  for (size_t t = 0; t < one.triangles.size(); t += 3)
    for (size_t u = 0; u < two.triangles.size(); u += 3) {
      bool meet = false;
      // In general position two triangles meet where an edge of one pierces the other.
      for (size_t e = 0; e < 3 && !meet; ++e)
        meet = Pierces(corner(one, t, e), corner(one, t, (e + 1) % 3), corner(two, u, 0), corner(two, u, 1),
                       corner(two, u, 2)) ||
               Pierces(corner(two, u, e), corner(two, u, (e + 1) % 3), corner(one, t, 0), corner(one, t, 1),
                       corner(one, t, 2));
      pairs += meet ? 1u : 0u;
    }
  EXPECT_GT(pairs, 50u);
  EXPECT_TRUE(Has(run.out, "3 labels: meshes of 1 pair meet each other, in " + std::to_string(pairs) + " pairs"))
      << pairs << run.out;
  const Ended apart = Call("segment " + Write("l.nrrd", Nrrd(23, Labels)) + " --all-labels --json -");
  EXPECT_TRUE(Has(apart.out, "\"crossings\":{\"triangle_pairs\":0,\"label_pairs\":0}")) << apart.out;
}

TEST_F(SegmentObjects, BandsOfGreyValues) {
  // Shells of grey values round the ring: 100 in the middle, and 10 less for each voxel outwards.
  const std::string volume =
      Write("ring.nrrd", Nrrd(23, [](int i, int j, int k) { return 100 - 10 * FromRing(i, j, k); }));
  EXPECT_EQ(
      Call("segment " + volume + " --seed 4,11,11 --lower 65 --genus 1 --radius 1 --out " + At("a.ply")).exit_code, 0);
  EXPECT_EQ(
      Call("segment " + volume + " --seed 4,11,11 --lower 65 --upper 200 --genus 1 --radius 1 --out " + At("b.ply"))
          .exit_code,
      0);
  const std::string dark = Write("dark.nrrd", Nrrd(23, [](int i, int j, int k) { return 10 * FromRing(i, j, k); }));
  EXPECT_EQ(Call("segment " + dark + " --seed 4,11,11 --upper 35 --genus 1 --radius 1 --out " + At("c.ply")).exit_code,
            0);
  for (const char* name : {"a.ply", "b.ply", "c.ply"})
    EXPECT_EQ(Genera(Read(At(name))), (std::vector<int64_t>{1})) << name;
  Refuse("segment " + volume + " --seed 4,11,11 --lower 65 --upper 90", {"outside the object"});
  Refuse("segment " + volume + " --seed 4,11,11 --lower 65 --upper 5", {"--lower must be below --upper"});
}

TEST_F(SegmentObjects, NanIsBackgroundOnRequest) {
  const std::string volume =
      Write("nan.nrrd", Nrrd(23, [](int i, int j, int k) { return FromRing(i, j, k) < 2.6 ? 100 : std::nan(""); }));
  const std::string call = "segment " + volume + " --seed 4,11,11 --lower 50 --radius 1";
  Refuse(call, {"NaN", "--nan-as-background"});
  const Ended run = Call(call + " --genus 1 --nan-as-background");
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST_F(SegmentObjects, FirstSurfaces) {
  const std::string volume =
      Write("ring.nrrd", Nrrd(23, [](int i, int j, int k) { return FromRing(i, j, k) < 2.6 ? 100 : 0; }));
  // A part of the ring, with a corner outside.
  const std::string mask = Write(
      "mask.nrrd", Nrrd(23, [](int i, int j, int k) { return i < 7 && j > 8 && j < 14 && k > 9 && k < 13 ? 1 : 0; }));
  const Ended by_mask =
      Call("segment " + volume + " --lower 50 --genus 1 --start-mask " + mask + " --out " + At("m.ply"));
  EXPECT_EQ(by_mask.exit_code, 0) << by_mask.err;
  EXPECT_TRUE(Has(by_mask.err, "the first surface reaches outside the object")) << by_mask.err;
  EXPECT_EQ(Genera(Read(At("m.ply"))), (std::vector<int64_t>{1}));
  const Ended by_mesh = Call("segment " + volume + " --lower 50 --genus 1 --start-mesh " + At("m.ply"));
  EXPECT_EQ(by_mesh.exit_code, 0) << by_mesh.err;
  const std::string off = Write("off.nrrd", Nrrd(23, [](int i, int j, int k) { return i + j + k < 4 ? 1 : 0; }));
  Refuse("segment " + volume + " --lower 50 --start-mask " + off, {"encloses no voxel of an object"});
  const std::string empty = Write("empty.nrrd", Nrrd(3, [](int, int, int) { return 0; }));
  Refuse("segment " + volume + " --lower 50 --start-mask " + empty, {"no voxel of the mask"});
  Refuse("segment " + volume + " --lower 50 --seed 4,11,11 --start-mask " + mask, {"is enough"});
  Refuse("segment " + volume + " --lower 50 --start-mesh " + At("none.ply"), {"no such file"});
}

}  // namespace
}  // namespace segment_objects_test
