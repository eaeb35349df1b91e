// SPDX-License-Identifier: MIT
// winding_samples: winding numbers of closed surfaces at the points of a grid, spread evenly within its cells so that
// no layer hides between the points. In doubles: a point nearer to the surface than rounding may count on either side.
#pragma once

#include "base/vec3.h"

namespace tpa {

// A box of side^3 cells, and of these the layers along z that are counted at once. A row of cells along x has one line
// of points: more points on a line cost less than more lines. Points measure the thickness of a layer across an axis
// within a tenth of a cell.
struct SampleGrid {
  static constexpr u32 coarse = 12, fine = 24;                                        // sides
  static constexpr u32 row = 48;                                                      // points of a line
  static constexpr u32 most_lines = coarse * coarse, most_points = row * most_lines;  // counted at once
  Vec3 low, cell;
  u32 side, layer;

  u32 layers() const { return most_lines / side; }
  u32 lines() const { return side * layers(); }
  u32 points() const { return row * lines(); }
  f64 step() const { return cell.x * side / row; }  // from point to point
  // Goes on to the next layers; false behind the last.
  bool next() {
    layer += layers();
    return layer < side;
  }
  f64 six_volumes_of_cell() const { return 6 * cell.x * cell.y * cell.z; }
  f64 six_volumes_of_point() const { return 6 * step() * cell.y * cell.z; }
  // Of n points at random the standard deviation is sqrt(n). Evenly spread ones have no more.
  f64 deviation_of_points(f64 count) const { return six_volumes_of_point() * square_root(count); }
  // The volume of so many points, rather more than less.
  f64 six_volumes_of_points(f64 count) const { return six_volumes_of_point() * count + deviation_of_points(count); }
};

// The grid over the box between two corners, at its first layers. A flat box gives cells without volume.
SampleGrid grid_between(const Vec3& low, const Vec3& high, u32 side);

// Enters a triangle of the surface. `change`, per point of the layers, becomes the difference to the winding number at
// the point before, along x; zeros at first. Returns the number of lines that may cross the triangle. Lines without a
// mark in `wanted` (unless nullptr) may be left out.
u32 add_crossings(const SampleGrid& g, const Vec3& a, const Vec3& b, const Vec3& c, i32* change,
                  const u8* wanted = nullptr);

// Turns differences into winding numbers.
void sum_crossings(const SampleGrid& g, i32 at_infinity, i32* change);

}  // namespace tpa
