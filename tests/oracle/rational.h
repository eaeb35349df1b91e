// SPDX-License-Identifier: MIT
// rational: fractions of integers of any size, and points where lines and planes meet. Nothing is ever rounded.
#pragma once

#include <array>
#include <cstddef>

#include "oracle/big_int.h"

namespace big_int {

struct Rational {
  BigInt over, under = 1;  // under > 0; not in lowest terms
  Rational() = default;
  Rational(BigInt numerator, BigInt denominator = 1);
  explicit Rational(double x);
  int sign() const { return over.sign(); }
};
Rational operator+(const Rational& a, const Rational& b);
Rational operator-(const Rational& a, const Rational& b);
Rational operator*(const Rational& a, const Rational& b);
// Pre: b is not zero.
Rational operator/(const Rational& a, const Rational& b);
// The sign of a - b.
int compare(const BigInt& a, const BigInt& b);
int compare(const Rational& a, const Rational& b);

using RationalPoint = std::array<Rational, 3>;
RationalPoint rational(const Coordinates& p);
// By coordinates, x first.
int compare(const RationalPoint& a, const RationalPoint& b);
struct Less {
  bool operator()(const RationalPoint& a, const RationalPoint& b) const { return compare(a, b) < 0; }
};
// The turn of a, b, c as seen along an axis: +1 counter-clockwise.
int turn(size_t axis, const RationalPoint& a, const RationalPoint& b, const RationalPoint& c);

// normal . x = level, with normal = (b - a) x (c - a).
struct RationalPlane {
  RationalPoint normal;
  Rational level;
};
RationalPlane plane_through(const Coordinates& a, const Coordinates& b, const Coordinates& c);
RationalPlane plane_along(const Coordinates& a, const Coordinates& b, size_t axis);
Rational dot(const RationalPoint& a, const RationalPoint& b);
RationalPoint cross(const RationalPoint& a, const RationalPoint& b);

// False if the point is not unique.
bool line_meets_plane(const Coordinates& a, const Coordinates& b, const RationalPlane& plane, RationalPoint& out);
bool planes_meet(const RationalPlane& a, const RationalPlane& b, const RationalPlane& c, RationalPoint& out);

}  // namespace big_int
