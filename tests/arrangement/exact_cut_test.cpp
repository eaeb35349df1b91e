// SPDX-License-Identifier: MIT
// tpa_adapt on boxes with whole coordinates, against unit cells: full of faces in one plane, common edges, and corners
// on faces. A failure prints the seed and writes the mesh.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "oracle/big_int.h"
#include "oracle/mesh_oracle.h"
#include "support/share.h"
#include "support/support.h"

namespace exact_cut_test {
namespace {

using namespace support;

constexpr int side = 4;  // boxes lie within [0, side]^3

// ---------------------------------------------------------------- unit cells

struct Cells {
  std::array<bool, side * side * side> full{};
  static bool IsInside(int x) { return x >= 0 && x < side; }
  bool At(int x, int y, int z) const {
    return IsInside(x) && IsInside(y) && IsInside(z) && full[static_cast<size_t>((x * side + y) * side + z)];
  }
  int Count() const { return static_cast<int>(std::count(full.begin(), full.end(), true)); }
};

// Are the cells with this value among the eight round a lattice point connected through faces?
bool IsOnePart(const std::array<bool, 8>& round, bool value) {
  unsigned left = 0;
  for (unsigned i = 0; i < 8; ++i) left |= (round[i] == value ? 1u : 0u) << i;
  unsigned part = left & (0u - left);
  for (int i = 0; i < 3; ++i)
    for (unsigned k = 0; k < 8; ++k)
      if ((part >> k & 1) != 0)
        for (unsigned bit : {1u, 2u, 4u}) part |= left & 1u << (k ^ bit);
  return part == left;
}

// Do parts of the region, or of the space around, touch in an edge or a corner alone?
bool Touches(const Cells& cells) {
  for (int x = 0; x <= side; ++x)
    for (int y = 0; y <= side; ++y)
      for (int z = 0; z <= side; ++z) {
        std::array<bool, 8> round;
        for (int i = 0; i < 8; ++i)
          round[static_cast<size_t>(i)] = cells.At(x - (i & 1), y - (i >> 1 & 1), z - (i >> 2));
        if (!IsOnePart(round, true) || !IsOnePart(round, false)) return true;
      }
  return false;
}

// Of the closed cells: corners - edges + faces - cells, where a full cell has the element.
int EulerOf(const Cells& cells) {
  int sum = 0;
  // Elements at twice their middles: odd coordinates run along the element.
  for (int x = 0; x <= 2 * side; ++x)
    for (int y = 0; y <= 2 * side; ++y)
      for (int z = 0; z <= 2 * side; ++z) {
        bool full = false;
        for (int a : {x - 1, x})
          for (int b : {y - 1, y})
            for (int c : {z - 1, z}) full = full || cells.At(a >> 1, b >> 1, c >> 1);
        if (full) sum += (x + y + z) % 2 == 0 ? 1 : -1;
      }
  return sum;
}

// Connected parts, through faces, of the full cells or of the empty ones.
int PartsOf(const Cells& cells, bool value) {
  constexpr int wide = side + 2;  // with a layer of empty cells round all
  std::vector<int> seen(wide * wide * wide, 0), queue;
  const auto at = [&](int i) { return cells.At(i / wide / wide - 1, i / wide % wide - 1, i % wide - 1); };
  int parts = 0;
  for (int start = 0; start < wide * wide * wide; ++start) {
    if (seen[static_cast<size_t>(start)] != 0 || at(start) != value) continue;
    ++parts;
    queue.assign(1, start);
    seen[static_cast<size_t>(start)] = 1;
    while (!queue.empty()) {
      const int i = queue.back(), c[3] = {i / wide / wide, i / wide % wide, i % wide};
      queue.pop_back();
      constexpr int stride[3] = {wide * wide, wide, 1};
      for (int axis = 0; axis < 3; ++axis)
        for (int step : {-1, 1}) {
          if (c[axis] + step < 0 || c[axis] + step >= wide) continue;
          const int next = i + step * stride[axis];
          if (seen[static_cast<size_t>(next)] != 0 || at(next) != value) continue;
          seen[static_cast<size_t>(next)] = 1;
          queue.push_back(next);
        }
    }
  }
  return parts;
}

// ---------------------------------------------------------------- boxes

struct Scene {
  Mesh mesh;
  Cells cells;
};

struct Range {
  int low, high;
};
using Ranges = std::array<Range, 3>;

// Two to six boxes. Of every four scenes, one is of plates and bars at the border of space, which leave tunnels; one in
// forty is a shell.
std::vector<Ranges> RangesOf(uint64_t seed) {
  Random random(seed);
  const auto upto = [&](int n) { return static_cast<int>(random() % static_cast<uint64_t>(n + 1)); };
  const auto anywhere = [&] {
    const int low = upto(side - 1);
    return Range{low, low + 1 + upto(side - low - 1)};
  };
  const auto layer = [&](int at) { return at == 0 ? Range{0, 1} : Range{side - 1, side}; };
  std::vector<Ranges> out;
  for (int i = seed % 40 == 0 ? 6 : 2 + upto(4); i > 0; --i) {
    Ranges r{anywhere(), anywhere(), anywhere()};
    if (seed % 4 == 0) r = {Range{0, side}, Range{0, side}, Range{0, side}};
    if (seed % 40 == 0)
      r[static_cast<size_t>(i % 3)] = layer(i % 2);
    else if (seed % 4 == 0)
      for (int k = 1 + upto(1); k > 0; --k) r[static_cast<size_t>(upto(2))] = layer(upto(1));
    out.push_back(r);
  }
  return out;
}

Scene BoxesOf(uint64_t seed) {
  Scene scene;
  std::vector<Mesh> boxes;
  for (const auto& [x, y, z] : RangesOf(seed)) {
    boxes.push_back(
        Box({double(x.low), double(y.low), double(z.low)}, {double(x.high), double(y.high), double(z.high)}, 1));
    for (int i = x.low; i < x.high; ++i)
      for (int j = y.low; j < y.high; ++j)
        for (int k = z.low; k < z.high; ++k) scene.cells.full[static_cast<size_t>((i * side + j) * side + k)] = true;
  }
  scene.mesh = Together(boxes);
  return scene;
}

tpa_config LimitsTimes(uint32_t times) {
  tpa_config config = DefaultConfig(64 * times);
  config.max_contacts = 128 * times;
  config.max_cut_edges = 128 * times;
  config.max_events = 16 * times;
  config.max_components = 8 * times;
  config.max_pieces = 512 * times;
  return config;
}
constexpr uint32_t generous = 16;

struct Result {
  tpa_status status;
  tpa_report report;
  Mesh mesh;
};
Result Adapted(const Mesh& mesh, uint32_t times) {
  const Arena arena(LimitsTimes(times), mesh);
  Result out{TPA_OK, Sized<tpa_report>(), {}};
  out.status = tpa_adapt(*arena, nullptr, &out.report, nullptr);
  out.mesh = MeshOf(*arena);
  return out;
}

// Has the mesh exactly this volume? By integers: 2^160 times each coordinate.
bool HasVolume(const Mesh& m, int cells) {
  const auto whole = [](double x) { return x == 0 ? big_int::BigInt() : big_int::scaled(x); };
  const auto corner = [&](size_t h) {
    const Point p = PositionOf(m, m.triangles[h]);
    return big_int::BigVec{whole(p[0]), whole(p[1]), whole(p[2])};
  };
  big_int::BigInt sum;
  for (size_t h = 0; h < m.triangles.size(); h += 3) sum = sum + det3(corner(h), corner(h + 1), corner(h + 2));
  const big_int::BigInt one = whole(1);
  return (sum - one * one * one * (6 * cells)).sign() == 0;
}

// Rounded points stay in the planes of the boxes, so rounding takes nothing. Where parts touch,
// small gaps open.
TEST(ExactCut, OfBoxesBoundsTheirUnion) {
  int plain = 0, touching = 0, hollow = 0, tunnels = 0;
  for (uint64_t seed = 1; seed <= Share<uint64_t>(500); ++seed) {
    const Scene scene = BoxesOf(seed);
    const Result result = Adapted(scene.mesh, generous);
    const std::string name = "seed " + std::to_string(seed);
    const MeshOnFailure given("given " + name, scene.mesh), found("result " + name, result.mesh);
    EXPECT_EQ(result.status, TPA_OK);
    EXPECT_EQ(result.report.unresolved, 0u);
    ASSERT_TRUE(IsSound(result.mesh, "result")) << name;
    const Topology t = TopologyOf(result.mesh);
    const int cells = scene.cells.Count();
    if (Touches(scene.cells)) {
      EXPECT_NEAR(t.Volume(), cells, 0.02);
      ++touching;
    } else {
      const int bodies = PartsOf(scene.cells, true), cavities = PartsOf(scene.cells, false) - 1;
      EXPECT_TRUE(HasVolume(result.mesh, cells)) << t.Volume() << " instead of " << cells;
      EXPECT_EQ(static_cast<int>(t.components.size()), bodies + cavities);
      EXPECT_EQ(static_cast<int>(t.components.size()) - t.Genus(), EulerOf(scene.cells));
      ++plain;
      hollow += cavities > 0;
      tunnels += t.Genus() > 0;
    }
    ASSERT_FALSE(HasFailure()) << name;
  }
  EXPECT_GT(plain, Least(300));
  EXPECT_GT(touching, Least(100));
  EXPECT_GT(hollow, Least(10));
  EXPECT_GT(tunnels, Least(8));
}

// Another run and larger limits give the same bits. Limits too small are named, and the mesh stays.
TEST(ExactCut, DependsOnNoLimit) {
  int compared = 0, refused = 0;
  for (uint64_t seed = 1; seed <= Share<uint64_t>(50); ++seed) {
    const Scene scene = BoxesOf(seed);
    const Result wanted = Adapted(scene.mesh, generous);
    for (uint32_t times : {1u, 2u, 4u, generous}) {
      const Result result = Adapted(scene.mesh, times);
      const bool fits = result.status == TPA_OK;
      EXPECT_TRUE(fits || result.status == TPA_E_LIMIT) << result.status;
      const Mesh& expected = fits ? wanted.mesh : scene.mesh;
      EXPECT_EQ(result.mesh.positions, expected.positions);
      EXPECT_EQ(result.mesh.triangles, expected.triangles);
      (fits ? compared : refused) += 1;
      ASSERT_FALSE(HasFailure()) << "seed " << seed << " limits times " << times;
    }
  }
  EXPECT_GT(compared, Least(120));
  EXPECT_GT(refused, Least(10));
}

}  // namespace
}  // namespace exact_cut_test
