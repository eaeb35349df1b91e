// SPDX-License-Identifier: MIT
// Topology of voxels beside closed cells of all other voxels, and the range that noise leaves open.
#include "tool/segment/voxel_topology.h"

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <set>

#include "support/tool_support.h"
#include "tool/io/files.h"

namespace voxel_topology_test {
namespace {

using namespace support;
using VoxelTopology = Tool;

tool::Volume Grid(int nx, int ny, int nz) {
  tool::Volume grid;
  grid.nx = nx, grid.ny = ny, grid.nz = nz;
  grid.values.assign(static_cast<size_t>(nx * ny * nz), 0);
  return grid;
}

std::vector<uint8_t> Mask(const tool::Volume& grid, const std::function<bool(int, int, int)>& inside) {
  std::vector<uint8_t> mask(grid.voxels());
  for (int k = 0; k < grid.nz; ++k)
    for (int j = 0; j < grid.ny; ++j)
      for (int i = 0; i < grid.nx; ++i) mask[grid.index(i, j, k)] = inside(i, j, k) ? 1 : 0;
  return mask;
}

using Cell = std::array<int, 3>;

// The voxels with a mask of `value` of the grid in a margin of zeros.
std::set<Cell> Voxels(const tool::Volume& grid, const std::vector<uint8_t>& mask, int value) {
  std::set<Cell> voxels;
  for (int k = -1; k <= grid.nz; ++k)
    for (int j = -1; j <= grid.ny; ++j)
      for (int i = -1; i <= grid.nx; ++i) {
        const bool within = i >= 0 && j >= 0 && k >= 0 && i < grid.nx && j < grid.ny && k < grid.nz;
        if ((within ? mask[grid.index(i, j, k)] : 0) == value) voxels.insert({i, j, k});
      }
  return voxels;
}

// Pieces connected by steps of at most `reach` coordinates.
uint64_t CountPieces(std::set<Cell> voxels, int reach) {
  uint64_t pieces = 0;
  for (; !voxels.empty(); ++pieces)
    for (std::vector<Cell> front{voxels.extract(voxels.begin()).value()}; !front.empty();) {
      const Cell at = front.back();
      front.pop_back();
      for (int step = 0; step < 27; ++step) {
        const int x = step % 3 - 1, y = step / 3 % 3 - 1, z = step / 9 - 1;
        const auto found = voxels.find({at[0] + x, at[1] + y, at[2] + z});
        if (std::abs(x) + std::abs(y) + std::abs(z) > reach || found == voxels.end()) continue;
        front.push_back(*found);
        voxels.erase(found);
      }
    }
  return pieces;
}

// Of the union of closed cubes: corners - edges + faces - cubes, each counted once, in half units.
int64_t EulerNumberOfCubes(const std::set<Cell>& voxels) {
  std::set<Cell> cells;
  for (const Cell& v : voxels)
    for (int part = 0; part < 27; ++part)
      cells.insert({2 * v[0] + part % 3 - 1, 2 * v[1] + part / 3 % 3 - 1, 2 * v[2] + part / 9 - 1});
  int64_t sum = 0;
  for (const Cell& c : cells) sum += (std::abs(c[0] % 2) + std::abs(c[1] % 2) + std::abs(c[2] % 2)) % 2 == 0 ? -1 : 1;
  return sum;
}

// Two bodies that fill a ball together, and share the border of the first: 1 = E(second) + E(first) - E(border), and
// E(border) = 2 E(first).
TEST(VoxelTopologyOf, RandomVoxelsByTheCubesOfAllOthers) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    const tool::Volume grid = Grid(1 + static_cast<int>(random() % 6), 1 + static_cast<int>(random() % 6), 5);
    const std::vector<uint8_t> mask = Mask(grid, [&](int, int, int) { return random() % 200 < 20 + seed % 170; });
    const std::set<Cell> set = Voxels(grid, mask, 1), others = Voxels(grid, mask, 0);
    const tool::VoxelTopology found = tool::topology_of(grid, mask);
    const uint64_t surfaces = CountPieces(set, 1) + CountPieces(others, 3) - 1;
    EXPECT_EQ(found.voxels, set.size()) << "seed " << seed;
    EXPECT_EQ(found.surfaces, surfaces) << "seed " << seed;
    EXPECT_EQ(found.genus, static_cast<int64_t>(surfaces) - (EulerNumberOfCubes(others) - 1)) << "seed " << seed;
  }
}

TEST(VoxelTopologyOf, BodiesOfKnownTopology) {
  const tool::Volume grid = Grid(30, 30, 30);
  const auto of = [&](const std::function<bool(int, int, int)>& inside) {
    const tool::VoxelTopology t = tool::topology_of(grid, Mask(grid, inside));
    return std::pair<uint64_t, int64_t>{t.surfaces, t.genus};
  };
  using Pair = std::pair<uint64_t, int64_t>;
  const auto radius = [](int i, int j, int k) { return std::hypot(i - 15, j - 15, k - 15); };
  EXPECT_EQ(of([](int, int, int) { return false; }), (Pair{0, 0}));
  EXPECT_EQ(of([](int, int, int) { return true; }), (Pair{1, 0}));
  EXPECT_EQ(of([&](int i, int j, int k) { return radius(i, j, k) < 12 && radius(i, j, k) > 8; }), (Pair{2, 0}));
  EXPECT_EQ(of([](int i, int j, int k) { return std::hypot(std::hypot(i - 15, j - 15) - 9, k - 15) < 3; }),
            (Pair{1, 1}));
  // A tube within a ring has a border of two tori.
  EXPECT_EQ(of([](int i, int j, int k) {
              const double away = std::hypot(std::hypot(i - 15, j - 15) - 9, k - 15);
              return away < 5 && away > 2;
            }),
            (Pair{2, 2}));
  // The frame of a cube: twelve edges, eight corners.
  EXPECT_EQ(of([](int i, int j, int k) { return (i % 25 < 4) + (j % 25 < 4) + (k % 25 < 4) >= 2; }), (Pair{1, 5}));
}

std::string Nrrd(int n, const std::function<double(int, int, int)>& grey) {
  std::string bytes = "NRRD0004\ntype: float\ndimension: 3\nsizes: " + std::to_string(n) + " " + std::to_string(n) +
                      " " + std::to_string(n) + "\nendian: little\nencoding: raw\n\n";
  for (int k = 0; k < n; ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) tool::append_little_endian(bytes, static_cast<float>(grey(i, j, k)));
  return bytes;
}

// A ring whose wall has a gap of dim voxels: 20 grey values beyond the threshold, where the noise has a deviation of
// 25. Without noise the ring is as sure as the gap's grey values.
double DimRing(double i, double j, double k) {
  const double depth = 5 - std::hypot(std::hypot(i - 16, j - 16) - 9, k - 16);
  const double full = i > 22 && std::fabs(j - 16) < 3 ? 120 : 500;
  return std::clamp(100 + 200 * depth, 0.0, full);
}

TEST_F(VoxelTopology, NoiseDecidesOnDimParts) {
  const std::string clear = Write("clear.nrrd", Nrrd(33, DimRing));
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0, 25);
  const std::string noisy =
      Write("noisy.nrrd", Nrrd(33, [&](int i, int j, int k) { return DimRing(i, j, k) + noise(random); }));
  const auto call = [&](const std::string& volume) {
    return Call("segment " + volume + " --threshold 100 --bright --seed 7,16,16 --partial --json " + At("r.json"));
  };
  const Ended sure = call(clear);
  EXPECT_EQ(sure.exit_code, 0) << sure.err;
  EXPECT_EQ(sure.err.find("noise decides"), std::string::npos) << sure.err;
  EXPECT_NE(Contents(At("r.json")).find("\"surfaces\":1,\"genus\":1},\"surest\""), std::string::npos)
      << Contents(At("r.json"));
  const Ended unsure = call(noisy);
  EXPECT_NE(unsure.err.find("noise decides on the topology"), std::string::npos) << unsure.err;
}

}  // namespace
}  // namespace voxel_topology_test
