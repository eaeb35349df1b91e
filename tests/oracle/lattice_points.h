// SPDX-License-Identifier: MIT
// lattice_points: points with whole coordinates, at random and stretched, and what their hulls have in common, as a
// linear programme over barycentric coordinates, solved by listing all basic solutions in rationals.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "oracle/coordinates.h"

namespace lattice_points {

using support::Coordinates;

constexpr unsigned seed = 20250611;

struct LatticePoint {
  long long x, y, z;
  bool operator==(const LatticePoint&) const = default;
};
Coordinates vec(LatticePoint g);
// An exact affine map for each axis. It keeps every answer, but fills mantissas and magnitudes.
Coordinates stretched(LatticePoint g, int kind);
// The seed and the points.
std::string print(const std::vector<LatticePoint>& points);

struct CommonPoint {
  long long x, y, z, w;  // w > 0, the point is (x, y, z) / w
};

// Does `wanted` accept a corner of the common point set of hull(p) and hull(q), each of up to three points?
bool common_corner(const std::vector<LatticePoint>& p, const std::vector<LatticePoint>& q,
                   const std::function<bool(CommonPoint)>& wanted);
bool anywhere(CommonPoint);
bool is_at(CommonPoint p, LatticePoint g);
bool is_on_segment(CommonPoint p, LatticePoint u, LatticePoint v);

struct Random {
  std::mt19937_64 engine{seed};
  long long upto(long long n) { return static_cast<long long>(engine() % static_cast<uint64_t>(n + 1)); }
  long long within(long long n) { return upto(2 * n) - n; }
  LatticePoint point(long long n) { return {upto(n), upto(n), upto(n)}; }
  double unit() { return static_cast<double>(engine() >> 11) * 0x1p-53; }
  double any_magnitude() {
    const double m = (1 + unit()) * std::ldexp(1.0, static_cast<int>(within(100)));
    return (engine() & 1) ? -std::min(m, 0x1p100) : std::min(m, 0x1p100);
  }
};

}  // namespace lattice_points
