// SPDX-License-Identifier: MIT
#include "oracle/rational.h"

#include <algorithm>
#include <utility>

namespace big_int {

namespace {

// Drops common factors 2^32.
void shorten(BigInt& a, BigInt& b) {
  size_t zeros = 0;
  while (zeros < a.limb.size() && zeros < b.limb.size() && a.limb[zeros] == 0 && b.limb[zeros] == 0) ++zeros;
  for (BigInt* x : {&a, &b}) x->limb.erase(x->limb.begin(), x->limb.begin() + static_cast<std::ptrdiff_t>(zeros));
}

RationalPoint difference(const RationalPoint& a, const RationalPoint& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// The unknown `wanted` of three equations normal . x = level, by elimination of the other two.
bool solve_for(size_t wanted, std::array<RationalPlane, 3> e, Rational& out) {
  size_t first = 0;
  for (size_t unknown = 0; unknown < 3; ++unknown) {
    if (unknown == wanted) continue;
    size_t pivot = first;
    while (pivot < 3 && e[pivot].normal[unknown].sign() == 0) ++pivot;
    if (pivot == 3) return false;
    std::swap(e[first], e[pivot]);
    const RationalPlane& from = e[first++];
    for (size_t row = first; row < 3; ++row) {
      const Rational own = from.normal[unknown], other = e[row].normal[unknown];
      for (size_t i = 0; i < 3; ++i) e[row].normal[i] = e[row].normal[i] * own - from.normal[i] * other;
      e[row].level = e[row].level * own - from.level * other;
    }
  }
  if (e[2].normal[wanted].sign() == 0) return false;
  out = e[2].level / e[2].normal[wanted];
  return true;
}

}  // namespace

Rational::Rational(BigInt numerator, BigInt denominator) : over(std::move(numerator)), under(std::move(denominator)) {
  if (over.sign() == 0) {
    over = 0;
    under = 1;
    return;
  }
  over.negative = over.negative != under.negative;
  under.negative = false;
  shorten(over, under);
}
Rational::Rational(double x) : Rational(x == 0 ? BigInt(0) : scaled(x), scaled(1)) {}

Rational operator+(const Rational& a, const Rational& b) {
  return {a.over * b.under + b.over * a.under, a.under * b.under};
}
Rational operator-(const Rational& a, const Rational& b) {
  return {a.over * b.under - b.over * a.under, a.under * b.under};
}
Rational operator*(const Rational& a, const Rational& b) { return {a.over * b.over, a.under * b.under}; }
Rational operator/(const Rational& a, const Rational& b) { return {a.over * b.under, a.under * b.over}; }

int compare(const BigInt& a, const BigInt& b) { return (a - b).sign(); }
int compare(const Rational& a, const Rational& b) { return compare(a.over * b.under, b.over * a.under); }

RationalPoint rational(const Coordinates& p) { return {Rational(p.x), Rational(p.y), Rational(p.z)}; }

int compare(const RationalPoint& a, const RationalPoint& b) {
  for (size_t i = 0; i < 3; ++i)
    if (const int order = compare(a[i], b[i]); order != 0) return order;
  return 0;
}

int turn(size_t axis, const RationalPoint& a, const RationalPoint& b, const RationalPoint& c) {
  const size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
  return compare((b[u] - a[u]) * (c[v] - a[v]), (b[v] - a[v]) * (c[u] - a[u]));
}

Rational dot(const RationalPoint& a, const RationalPoint& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
RationalPoint cross(const RationalPoint& a, const RationalPoint& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

RationalPlane plane_through(const Coordinates& a, const Coordinates& b, const Coordinates& c) {
  const RationalPoint p = rational(a);
  const RationalPoint normal = cross(difference(rational(b), p), difference(rational(c), p));
  return {normal, dot(normal, p)};
}
RationalPlane plane_along(const Coordinates& a, const Coordinates& b, size_t axis) {
  RationalPoint along;
  along[axis] = Rational(BigInt(1));
  const RationalPoint p = rational(a), normal = cross(difference(rational(b), p), along);
  return {normal, dot(normal, p)};
}

bool line_meets_plane(const Coordinates& a, const Coordinates& b, const RationalPlane& plane, RationalPoint& out) {
  const RationalPoint p = rational(a), way = difference(rational(b), p);
  const Rational slope = dot(plane.normal, way);
  if (slope.sign() == 0) return false;
  const Rational t = (plane.level - dot(plane.normal, p)) / slope;
  for (size_t i = 0; i < 3; ++i) out[i] = p[i] + t * way[i];
  return true;
}

bool planes_meet(const RationalPlane& a, const RationalPlane& b, const RationalPlane& c, RationalPoint& out) {
  for (size_t i = 0; i < 3; ++i)
    if (!solve_for(i, {a, b, c}, out[i])) return false;
  return true;
}

}  // namespace big_int
