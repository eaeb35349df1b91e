// SPDX-License-Identifier: MIT
// coordinates: a point of any type with members x, y and z, so that oracles need no header of the code under test.
#pragma once

#include <type_traits>

namespace support {

struct Coordinates {
  double x = 0, y = 0, z = 0;

  Coordinates() = default;
  Coordinates(double of_x, double of_y, double of_z) : x(of_x), y(of_y), z(of_z) {}
  template <class Vector>
  requires requires(const Vector& v) { v.x + v.y + v.z; }
  Coordinates(const Vector& v) : x(v.x), y(v.y), z(v.z) {}
  template <class Vector>
  requires(!std::is_same_v<Vector, Coordinates>) && requires(const Vector& v) { v.x + v.y + v.z; }
  operator Vector() const { return {x, y, z}; }
};

}  // namespace support
