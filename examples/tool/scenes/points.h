// SPDX-License-Identifier: MIT
// points: three coordinates as a value, and random points that are the same everywhere.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

namespace tool {

using Point = std::array<double, 3>;

constexpr double pi = 3.14159265358979323846;

inline Point operator+(const Point& a, const Point& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Point operator-(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Point operator*(double s, const Point& a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point& a) { return std::sqrt(dot(a, a)); }
// Precondition: not zero.
inline Point unit(const Point& a) { return 1 / length(a) * a; }

// Numbers from the generator of the standard; distributions of the standard differ from library to library.
class Dice {
 public:
  explicit Dice(uint64_t seed) : bits_(seed) {}
  double uniform(double low, double high) { return low + (high - low) * static_cast<double>(bits_() >> 11) * 0x1p-53; }
  // 0 .. count - 1; the bias is below count / 2^64.
  uint64_t below(uint64_t count) { return bits_() % count; }
  Point in_cube(double half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
  Point direction() {
    for (;;) {
      const Point p = in_cube(1);
      if (dot(p, p) > 0.01 && dot(p, p) <= 1) return unit(p);
    }
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace tool
