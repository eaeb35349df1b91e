// SPDX-License-Identifier: MIT
// polygon: cuts a polygon in space into triangles, whether the polygon is convex or not.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace tool {

// Appends n - 2 triangles to `triangles`, three corner numbers below n each, for a polygon of n >= 3 corners. `corners`
// holds x, y, z of each. Every corner is used and each side of the polygon belongs to one triangle, so a closed mesh
// stays closed. A polygon without self-intersections in the plane of its Newell normal gets no folded triangle. Corners
// may lie in line, or twice at one point as on a bridge to a hole; triangles without area appear only where nothing
// else is left. Equal input gives equal triangles. O(n r + n log n), r the number of corners that are not convex.
void triangulate(std::span<const double> corners, std::vector<uint32_t>& triangles);

// Is every corner clearly convex in the plane of the Newell normal?
bool is_convex(std::span<const double> corners);

// A cut in which as few diagonals as possible cross the polygon's sides or leave it, then as few as possible are taken;
// of these the cut with the shortest diagonals. In place of the cut in `triangles`, unless that is as good. Polygons of
// more than 64 corners keep theirs. O(n^3).
void triangulate_around(std::span<const double> corners, const std::function<bool(uint32_t, uint32_t)>& is_taken,
                        std::vector<uint32_t>& triangles);

}  // namespace tool
