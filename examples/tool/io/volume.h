// SPDX-License-Identifier: MIT
// volume: a scalar image on a regular grid. Voxel centres lie at integer coordinates (0..nx-1, ...), which an affine
// map takes to millimetres in the file's world, or to LPS in place of RAS.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tool/io/affine.h"
#include "tool/result.h"
#include "tool/workers.h"

namespace tool {

struct Volume {
  int nx = 0, ny = 0, nz = 0;
  Affine to_world;
  Space space = Space::unnamed;  // of the world
  bool is_turned = false;        // the world is LPS, that of the file RAS
  std::vector<float> values;     // x runs fastest, z slowest
  std::string note;              // one line on what the file leaves in doubt, or empty

  size_t index(int x, int y, int z) const {
    return (static_cast<size_t>(z) * static_cast<size_t>(ny) + static_cast<size_t>(y)) * static_cast<size_t>(nx) +
           static_cast<size_t>(x);
  }
  float at(int x, int y, int z) const { return values[index(x, y, z)]; }
  double sample(double x, double y, double z) const;
  size_t voxels() const { return values.size(); }
  Space space_of_file() const { return is_turned ? Space::ras : space; }
  // A place of the world in that of the file.
  Point in_file(const Point& p) const { return is_turned ? Point{-p[0], -p[1], p[2]} : p; }
};

// From RAS to LPS, so that equal voxels make equal meshes, whatever the format of the file.
void turn_to_lps(Volume& volume);

// Cube root of the volume of a voxel.
double mean_side(const Volume& volume);

// The two voxels around a coordinate and the weight of the upper one; outside the grid both are the border's.
struct AxisPosition {
  int lower, upper;
  double weight;
};

inline AxisPosition position_on_axis(double coordinate, int size) {
  const double last = static_cast<double>(size - 1);
  if (!(coordinate > 0)) return {0, 0, 0};  // NaN as well
  if (coordinate >= last) return {size - 1, size - 1, 0};
  const int lower = static_cast<int>(coordinate);
  return {lower, lower + 1, coordinate - static_cast<double>(lower)};
}

// Trilinear interpolation in voxel coordinates; beyond the border the nearest border value.
// Precondition: the volume is not empty.
inline double Volume::sample(double x, double y, double z) const {
  const AxisPosition px = position_on_axis(x, nx), py = position_on_axis(y, ny), pz = position_on_axis(z, nz);
  const auto along_x = [&](int row_y, int row_z) {
    const float* row = values.data() + index(0, row_y, row_z);
    const double a = row[px.lower], b = row[px.upper];
    return a + px.weight * (b - a);
  };
  const double y0 = along_x(py.lower, pz.lower), y1 = along_x(py.upper, pz.lower);
  const double y2 = along_x(py.lower, pz.upper), y3 = along_x(py.upper, pz.upper);
  const double z0 = y0 + py.weight * (y1 - y0), z1 = y2 + py.weight * (y3 - y2);
  return z0 + pz.weight * (z1 - z0);
}

inline constexpr double largest_sigma = 100;

// Separable Gaussian, sigma in millimetres and 0 to largest_sigma voxels along each axis, kernel cut at ceil(4 sigma)
// voxels and normalised, border values repeated outwards. Axes count as perpendicular. O(voxels * sigma) time, and a
// slice of memory for each thread while it runs.
Status smooth_gaussian(Volume& volume, double sigma, const Workers& workers = Workers());

}  // namespace tool
