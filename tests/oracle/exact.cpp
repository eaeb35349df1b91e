// SPDX-License-Identifier: MIT
#include "oracle/exact.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstdint>
#include <cstdlib>

namespace support {

namespace {

// Sum of limbs[i] * 2^(24 i) with a sign in every limb, so that adding and multiplying need no carries until the end.
// Coordinates within 2^-153 .. 2^101 have 11 limbs, and products of three of them 33; the rest is room for carries.
struct Integer {
  static constexpr size_t most = 64;
  size_t count = 0;
  int64_t limbs[most];

  Integer() {}
  explicit Integer(size_t zeros) : count(zeros) {
    if (count > most) std::abort();
    std::fill(limbs, limbs + count, 0);
  }
  Integer(const Integer& o) : count(o.count) { std::copy(o.limbs, o.limbs + o.count, limbs); }
  void Grow() {
    if (count == most) std::abort();
    limbs[count++] = 0;
  }
  Integer& operator=(const Integer& o) {
    count = o.count;
    std::copy(o.limbs, o.limbs + o.count, limbs);
    return *this;
  }
};

Integer Combined(const Integer& a, const Integer& b, int64_t factor) {
  Integer out(std::max(a.count, b.count));
  for (size_t i = 0; i < a.count; ++i) out.limbs[i] += a.limbs[i];
  for (size_t i = 0; i < b.count; ++i) out.limbs[i] += factor * b.limbs[i];
  return out;
}

// Limbs within (-2^24, 2^24).
Integer Carried(Integer a) {
  int64_t carry = 0;
  for (size_t i = 0; i < a.count || carry != 0; ++i) {
    if (i == a.count) a.Grow();
    const int64_t limb = a.limbs[i] + carry;
    carry = limb / (1 << 24);
    a.limbs[i] = limb - carry * (1 << 24);
  }
  while (a.count > 0 && a.limbs[a.count - 1] == 0) --a.count;
  return a;
}

// Products of limbs are below 2^48, so sums of up to 2^14 products fit.
Integer Product(const Integer& a, const Integer& b) {
  Integer out(a.count + b.count);
  for (size_t i = 0; i < a.count; ++i)
    for (size_t k = 0; k < b.count; ++k) out.limbs[i + k] += a.limbs[i] * b.limbs[k];
  return Carried(out);
}

// The limbs below the highest add up to less than one unit of the highest.
int SignOf(const Integer& a) {
  const Integer c = Carried(a);
  return c.count == 0 ? 0 : c.limbs[c.count - 1] > 0 ? 1 : -1;
}

// The exponent of the last bit of a double.
int LastBit(double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  return exponent - 53;
}

// x / 2^unit, whole.
Integer Whole(double x, int unit) {
  if (x == 0) return {};
  int exponent = 0;
  const double fraction = std::frexp(x, &exponent);
  const auto mantissa = static_cast<int64_t>(fraction * 0x1p53);
  const int shift = exponent - 53 - unit;
  Integer out(static_cast<size_t>(shift / 24) + 4);
  const int within = shift % 24;
  const int64_t sign = mantissa < 0 ? -1 : 1;
  auto rest = static_cast<uint64_t>(sign * mantissa);
  for (int k = 0; k < 3; ++k, rest >>= 24)
    out.limbs[static_cast<size_t>(shift / 24 + k)] = sign * (static_cast<int64_t>(rest & 0xFFFFFF) << within);
  return Carried(out);
}

int ExactDeterminant(const double (&p)[4][3], int n) {
  // Rows p[1] - p[0] .. p[n] - p[0] of n columns.
  int unit = INT_MAX;
  for (int i = 0; i <= n; ++i)
    for (int k = 0; k < n; ++k)
      if (p[i][k] != 0) unit = std::min(unit, LastBit(p[i][k]));
  Integer r[3][3];
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) r[i][k] = Carried(Combined(Whole(p[i + 1][k], unit), Whole(p[0][k], unit), -1));
  const auto minor = [&](int i, int k, int a, int b) {
    return Carried(Combined(Product(r[i][a], r[k][b]), Product(r[i][b], r[k][a]), -1));
  };
  if (n == 2) return SignOf(minor(0, 1, 0, 1));
  return SignOf(Combined(Combined(Product(r[0][0], minor(1, 2, 1, 2)), Product(r[0][1], minor(1, 2, 0, 2)), -1),
                         Product(r[0][2], minor(1, 2, 0, 1)), 1));
}

// Quarters below 64: differences have at most ten bits, so plain determinants of differences are exact.
bool OnSmallLattice(const Point& p) {
  for (double x : p)
    if (!(std::fabs(x) < 64 && 4 * x == std::floor(4 * x))) return false;
  return true;
}

}  // namespace

int Turn(const Point& a, const Point& b, const Point& c, size_t x, size_t y) {
  const double left = (b[x] - a[x]) * (c[y] - a[y]), right = (b[y] - a[y]) * (c[x] - a[x]);
  if (OnSmallLattice(a) && OnSmallLattice(b) && OnSmallLattice(c)) return (left > right) - (left < right);
  if (std::fabs(left - right) > 1e-14 * (std::fabs(left) + std::fabs(right))) return left > right ? 1 : -1;
  const double p[4][3] = {{a[x], a[y], 0}, {b[x], b[y], 0}, {c[x], c[y], 0}, {0, 0, 0}};
  return ExactDeterminant(p, 2);
}

int Side(const Point& a, const Point& b, const Point& c, const Point& d) {
  const Point u = Difference(b, a), v = Difference(c, a), w = Difference(d, a);
  double sum = 0, size = 0;
  for (size_t i = 0; i < 3; ++i) {
    const size_t k = (i + 1) % 3, l = (i + 2) % 3;
    sum += w[i] * (u[k] * v[l] - u[l] * v[k]);
    size += std::fabs(w[i]) * (std::fabs(u[k] * v[l]) + std::fabs(u[l] * v[k]));
  }
  // The bound of Shewchuk 1997, 7.8e-16.
  if (std::fabs(sum) > 1e-15 * size) return sum > 0 ? 1 : -1;
  if (d == a || d == b || d == c || a == b || b == c || c == a) return 0;  // as for triangles with a common vertex
  if (OnSmallLattice(a) && OnSmallLattice(b) && OnSmallLattice(c) && OnSmallLattice(d)) return (sum > 0) - (sum < 0);
  const double p[4][3] = {{a[0], a[1], a[2]}, {b[0], b[1], b[2]}, {c[0], c[1], c[2]}, {d[0], d[1], d[2]}};
  return ExactDeterminant(p, 3);
}

}  // namespace support
