// SPDX-License-Identifier: MIT
// phantom_shapes: the measures of the phantoms' primitives, in voxels, and the sign function they combine to.
#pragma once

#include <algorithm>
#include <cmath>

#include "tool/segment/phantom.h"

namespace tool {

inline constexpr double cube_centre = 50, cube_half = 35, cavity_radius = 40;
inline constexpr double tori_centre = 50, tori_ring = 32, tori_tube = 9;
inline constexpr double nested_centre = 50, nested_ring = 30, nested_tube = 13, nested_ball = 6;
inline constexpr double cyst_centre[3] = {99, 49, 85}, cyst_axes[3] = {75, 36, 65}, rod_radius = 4;

// Each is negative inside, zero on the surface, positive outside; exact at integer points where the measures
// are.
inline double ball_level(double x, double y, double z, double radius) {
  return x * x + y * y + z * z - radius * radius;
}
inline double cube_level(double x, double y, double z, double half) {
  return std::max({std::fabs(x), std::fabs(y), std::fabs(z)}) - half;
}
// `radial_squared` is the squared distance from the axis, `height` the one from the ring's plane.
inline double torus_level(double radial_squared, double height, double ring, double tube) {
  const double off_ring = std::sqrt(radial_squared) - ring;
  return off_ring * off_ring + height * height - tube * tube;
}
inline double ellipsoid_level(double x, double y, double z, const double (&axes)[3]) {
  const double a = x / axes[0], b = y / axes[1], c = z / axes[2];
  return a * a + b * b + c * c - 1;
}

// Union is the least of the levels, "minus B" the greatest with -level(B).
inline double level_of(PhantomShape shape, double x, double y, double z) {
  switch (shape) {
    case PhantomShape::cube_cavity: {
      const double u = x - cube_centre, v = y - cube_centre, w = z - cube_centre;
      return std::max(cube_level(u, v, w, cube_half), -ball_level(u, v, w, cavity_radius));
    }
    case PhantomShape::genus_3: {
      const double u = x - tori_centre, v = y - tori_centre, w = z - tori_centre;
      return std::min(torus_level(u * u + w * w, v, tori_ring, tori_tube),
                      torus_level(v * v + w * w, u, tori_ring, tori_tube));
    }
    case PhantomShape::torus_nested: {
      const double u = std::fabs(x - nested_centre), v = std::fabs(y - nested_centre), w = z - nested_centre;
      const double balls =
          std::min(ball_level(u - nested_ring, v, w, nested_ball), ball_level(u, v - nested_ring, w, nested_ball));
      return std::max(torus_level(u * u + v * v, w, nested_ring, nested_tube), -balls);
    }
    case PhantomShape::cyst: {
      const double u = x - cyst_centre[0], v = y - cyst_centre[1], w = z - cyst_centre[2];
      return std::max(ellipsoid_level(u, v, w, cyst_axes), -ball_level(u, 0, w, rod_radius));
    }
  }
  return 1;
}

// Fills phantom.seam and phantom.seam_starts.
void trace_seam(Phantom& phantom);

}  // namespace tool
