// SPDX-License-Identifier: MIT
// grid_triangles: which triangles with corners on a grid of small integers meet beyond a common corner or edge? Exact,
// by points with rational coordinates, and for triangles of any kind: without area, or all in one point.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace fuzz {

constexpr int64_t most_coordinate = 64;  // either sign; keeps all numbers below 2^62

using GridPoint = std::array<int64_t, 3>;
struct GridTriangle {
  std::array<GridPoint, 3> at;
  std::array<uint32_t, 3> corner;  // vertices
};

// The common part of two convex sets is convex. So it lies within a common corner or edge exactly if its own corners
// do: corners of one triangle in the other one, and crossings of sides with the other triangle or its sides. Triangles
// with a common edge and two corners in one place meet by definition.
bool GridTrianglesMeet(const GridTriangle& s, const GridTriangle& t);

}  // namespace fuzz
