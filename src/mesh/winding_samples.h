// SPDX-License-Identifier: MIT
// winding_samples: winding numbers of closed surfaces at the points of a grid, a point in each cell, spread evenly
// within the cells so that no layer hides between the points. In doubles: a point nearer to the surface than rounding
// may count on either side.
#pragma once

#include "base/vec3.h"

namespace tpa {

// A box of side^3 cells. The points measure the thickness of a layer across an axis within a tenth of a cell.
struct SampleGrid {
  static constexpr u32 side = 24;
  static constexpr u32 points = side * side * side;
  // Of a mesh with so many faces, entered as it was and as it is, 16 bits hold each winding number and each difference.
  static constexpr u32 most_faces_in_16_bits = 16000;
  Vec3 low, cell;

  f64 six_volumes_of_cell() const { return 6 * cell.x * cell.y * cell.z; }
  // The cells of so many points, rather more than less: of n points at random the standard deviation is sqrt(n).
  f64 six_volumes_of_points(f64 count) const { return six_volumes_of_cell() * (count + square_root(count)); }
};

// The grid over the box between two corners. A flat box gives cells without volume.
SampleGrid grid_between(const Vec3& low, const Vec3& high);

// Enters a triangle of the surface. `change`, per point of the grid, becomes the difference to the winding number at
// the point before, along x; zeros at first. Returns the number of lines of the grid that may cross the triangle.
template <class Winding>
u32 add_crossings(const SampleGrid& g, const Vec3& a, const Vec3& b, const Vec3& c, Winding* change);

// Turns differences into winding numbers.
template <class Winding>
void sum_crossings(i32 at_infinity, Winding* change);

}  // namespace tpa
