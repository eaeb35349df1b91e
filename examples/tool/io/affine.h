// SPDX-License-Identifier: MIT
// affine: the map from voxel indices to millimetres in a named world.
#pragma once

#include "tool/scenes/points.h"

namespace tool {

// Directions in which the coordinates of a world grow: x to the right or the left, y to the front (anterior) or the
// back, z upwards. RAS and LPS differ by the signs of x and y.
enum class Space { unnamed, ras, lps };

const char* name_of(Space space);  // "unnamed", "ras", "lps"

struct Affine {
  Point axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // one voxel along each index
  Point origin{};                                     // centre of voxel (0, 0, 0)

  Point operator()(const Point& p) const {
    Point at = origin;
    for (size_t k = 0; k < 3; ++k) at[k] = axes[0][k] * p[0] + axes[1][k] * p[1] + axes[2][k] * p[2] + origin[k];
    return at;
  }
  double spacing(size_t axis) const { return length(axes[axis]); }
};

// Volume of a voxel, negative under a mirrored map.
double determinant(const Affine& map);

// Is the map finite, with a voxel whose sides are long enough and not nearly in one plane?
bool is_regular(const Affine& map);

// The inverse. Precondition: is_regular.
Affine inverse(const Affine& map);

// The map with x and y of the world negated: from RAS to LPS and back.
Affine turned_about_z(const Affine& map);

}  // namespace tool
