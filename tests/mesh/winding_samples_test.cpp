// SPDX-License-Identifier: MIT
// Winding numbers at the points of a grid, against volumes known by formulas.
#include "mesh/winding_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "oracle/mesh_oracle.h"
#include "support/sample_meshes.h"
#include "support/tangle_shapes.h"

namespace winding_samples_test {
namespace {

using namespace support;
using tpa::SampleGrid;

constexpr uint32_t side = SampleGrid::fine, row = SampleGrid::row;

tpa::Vec3 VectorOf(const Point& p) { return {p[0], p[1], p[2]}; }

// Layer by layer, as they are counted.
std::vector<int32_t> WindingIn(SampleGrid grid, const Mesh& m, int32_t at_infinity) {
  std::vector<int32_t> all;
  do {
    std::vector<int32_t> winding(grid.points(), 0);
    for (size_t t = 0; t < m.triangles.size(); t += 3) {
      const auto corner = [&](size_t i) { return VectorOf(PositionOf(m, m.triangles[t + i])); };
      tpa::add_crossings(grid, corner(0), corner(1), corner(2), winding.data());
    }
    tpa::sum_crossings(grid, at_infinity, winding.data());
    all.insert(all.end(), winding.begin(), winding.end());
  } while (grid.next());
  EXPECT_EQ(all.size(), grid.side * grid.side * row);
  return all;
}

double VolumeAt(const SampleGrid& grid, const std::vector<int32_t>& winding, int32_t least) {
  const auto inside = std::count_if(winding.begin(), winding.end(), [&](int32_t w) { return w >= least; });
  return static_cast<double>(inside) * grid.six_volumes_of_point() / 6;
}

SampleGrid GridRound(const Point& low, const Point& high) {
  return tpa::grid_between(VectorOf(low), VectorOf(high), side);
}

// A share p of independent points: three sigma.
double Tolerance(double share) { return 3 * std::sqrt(share / (side * side * row)); }

TEST(WindingSamples, OfABallHaveItsVolume) {
  for (const double radius : {0.3, 0.6, 0.9}) {
    const Mesh ball = Sphere({.05, -.03, .02}, radius, 8);
    const SampleGrid grid = GridRound({-1, -1, -1}, {1, 1, 1});
    const std::vector<int32_t> winding = WindingIn(grid, ball, 0);
    const double share = TopologyOf(ball).Volume() / 8;
    EXPECT_NEAR(VolumeAt(grid, winding, 1) / 8, share, Tolerance(share)) << radius;
    EXPECT_EQ(*std::max_element(winding.begin(), winding.end()), 1);
    EXPECT_EQ(*std::min_element(winding.begin(), winding.end()), 0);
  }
}

TEST(WindingSamples, MeasureLayersWithinATenthOfACell) {
  const SampleGrid grid = GridRound({0, 0, 0}, {side, side, side});
  for (size_t axis = 0; axis < 3; ++axis)
    for (int i = 0; i < 100; ++i) {
      const double place = 2 + 0.13 * i, thickness = 0.2 + 0.017 * i;
      Point low = {-1, -1, -1}, high = {side + 1, side + 1, side + 1};
      low[axis] = place;
      high[axis] = place + thickness;
      const double measured = VolumeAt(grid, WindingIn(grid, Box(low, high, 1), 0), 1) / (side * side);
      EXPECT_NEAR(measured, thickness, 0.1) << "axis " << axis << " at " << place;
    }
}

// Plates of a thickness below that of a cell, anywhere and in all directions.
TEST(WindingSamples, OfThinPlatesDeviateNoMoreThanPointsAtRandom) {
  Random random(7);
  for (const uint32_t sides : {SampleGrid::coarse, SampleGrid::fine}) {
    const SampleGrid grid = tpa::grid_between({-1, -1, -1}, {1, 1, 1}, sides);
    double squares = 0;
    constexpr int plates = 400;
    for (int i = 0; i < plates; ++i) {
      Point at;
      for (double& x : at) x = Uniform(random, -.3, .3);
      const double half = Uniform(random, .02, .6) / sides;
      const Mesh plate = Translated(RandomlyTurned(Box({-.4, -.3, -half}, {.4, .3, half}, 1), random), at);
      const double volume = .8 * .6 * 2 * half, point = grid.six_volumes_of_point() / 6;
      const double off = VolumeAt(grid, WindingIn(grid, plate, 0), 1) - volume;
      squares += off * off / (volume * point);
    }
    EXPECT_LT(std::sqrt(squares / plates), 1) << sides;
  }
}

// Faces all over the planes of integers, where a ray could pass between two faces or count both.
TEST(WindingSamples, DoNotLeak) {
  std::vector<Mesh> boxes;
  for (int i = 0; i < 40; ++i) {
    const double x = i % 5, y = i / 5 % 4, z = i / 20;
    boxes.push_back(Box({x, y, z}, {x + 2, y + 2, z + 2}, 1));
  }
  const SampleGrid grid = GridRound({-1, -1, -1}, {23, 23, 23});  // cells of side 1
  const std::vector<int32_t> winding = WindingIn(grid, Together(boxes), 0);
  for (uint32_t line = 0; line < side * side; ++line) EXPECT_EQ(winding[row * line + row - 1], 0) << line;
  double sum = 0;
  for (const int32_t w : winding) {
    EXPECT_GE(w, 0);
    sum += w;
  }
  EXPECT_NEAR(sum * side / row, 40 * 8, 40);
}

TEST(WindingSamples, OfAVoidHaveOneAtInfinity) {
  Mesh ball = Sphere({0, 0, 0}, 0.8, 8);
  for (size_t t = 0; t < ball.triangles.size(); t += 3) std::swap(ball.triangles[t], ball.triangles[t + 1]);
  const SampleGrid grid = GridRound({-1, -1, -1}, {1, 1, 1});
  const double outside = 8 + TopologyOf(ball).Volume();
  EXPECT_NEAR(VolumeAt(grid, WindingIn(grid, ball, 1), 1), outside, 8 * Tolerance(outside / 8));
}

}  // namespace
}  // namespace winding_samples_test
