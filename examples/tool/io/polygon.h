// SPDX-License-Identifier: MIT
// polygon: cuts a polygon in space into triangles, whether the polygon is convex or not.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tool {

// Appends n - 2 triangles to `triangles`, three corner numbers below n each, for a polygon of n >= 3 corners. `corners`
// holds x, y, z of each. Every corner is used and each side of the polygon belongs to one triangle, so a closed mesh
// stays closed. A polygon without self-intersections in the plane of its Newell normal gets no folded triangle. Corners
// may lie in line, or twice at one point as on a bridge to a hole; triangles without area appear only where nothing
// else is left. Equal input gives equal triangles. O(n r + n log n), r the number of corners that are not convex.
void triangulate(std::span<const double> corners, std::vector<uint32_t>& triangles);

}  // namespace tool
