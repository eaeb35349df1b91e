// SPDX-License-Identifier: MIT
// big_int: integers of any size, and signs of determinants of doubles by them: doubles are dyadic rationals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "oracle/coordinates.h"

namespace big_int {

using support::Coordinates;

struct BigInt {
  bool negative = false;
  std::vector<uint32_t> limb;  // little endian, no leading zeros
  BigInt() = default;
  BigInt(long long v) : negative(v < 0) {
    auto m = negative ? 0 - static_cast<unsigned long long>(v) : static_cast<unsigned long long>(v);
    for (; m; m >>= 32) limb.push_back(static_cast<uint32_t>(m));
  }
  int sign() const { return limb.empty() ? 0 : negative ? -1 : 1; }
  void trim() {
    while (!limb.empty() && limb.back() == 0) limb.pop_back();
  }
};
BigInt operator+(const BigInt& a, const BigInt& b);
BigInt operator-(const BigInt& a, const BigInt& b);
BigInt operator*(const BigInt& a, const BigInt& b);
// 2^160 x, an integer for every coordinate in range.
BigInt scaled(double x);

struct BigVec {
  BigInt x, y, z;
};
BigVec operator-(const BigVec& a, const BigVec& b);
BigInt det2(const BigInt& a, const BigInt& b, const BigInt& c, const BigInt& d);
BigInt det3(const BigVec& u, const BigVec& v, const BigVec& w);

// Signs of (b - a) x (c - a) and of det(b - a, c - a, d - a).
int orientation(double ax, double ay, double bx, double by, double cx, double cy);
int orientation(const Coordinates& a, const Coordinates& b, const Coordinates& c, const Coordinates& d);

}  // namespace big_int
