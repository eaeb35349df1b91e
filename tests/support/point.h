// SPDX-License-Identifier: MIT
// point: points and vectors in space, in doubles.
#pragma once

#include <array>
#include <cmath>

namespace support {

using Point = std::array<double, 3>;

constexpr double pi = 3.14159265358979323846;

inline Point Sum(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point Difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point Scaled(double s, const Point& p) { return {s * p[0], s * p[1], s * p[2]}; }
inline double Dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point Cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double Length(const Point& a) { return std::sqrt(Dot(a, a)); }
inline double Distance(const Point& a, const Point& b) { return Length(Difference(a, b)); }
inline Point Unit(const Point& a) { return Scaled(1 / Length(a), a); }

}  // namespace support
