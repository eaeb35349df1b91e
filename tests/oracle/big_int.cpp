// SPDX-License-Identifier: MIT
#include "oracle/big_int.h"

#include <cmath>

namespace big_int {

namespace {

int compare_size(const BigInt& a, const BigInt& b) {
  if (a.limb.size() != b.limb.size()) return a.limb.size() < b.limb.size() ? -1 : 1;
  for (size_t i = a.limb.size(); i-- > 0;) {
    if (a.limb[i] != b.limb[i]) return a.limb[i] < b.limb[i] ? -1 : 1;
  }
  return 0;
}
BigInt add(const BigInt& a, const BigInt& b, bool b_negative) {
  BigInt r;
  const bool same = a.negative == b_negative;
  const bool a_first = compare_size(a, b) >= 0;
  const BigInt &big = a_first ? a : b, &small = a_first ? b : a;
  r.negative = a_first ? a.negative : b_negative;
  long long carry = 0;
  for (size_t i = 0; i < big.limb.size(); ++i) {
    const long long s = i < small.limb.size() ? small.limb[i] : 0;
    long long v = static_cast<long long>(big.limb[i]) + (same ? s : -s) + carry;
    carry = v >> 32;
    r.limb.push_back(static_cast<uint32_t>(v & 0xFFFFFFFFll));
  }
  if (carry > 0) r.limb.push_back(static_cast<uint32_t>(carry));
  r.trim();
  return r;
}

}  // namespace

BigInt operator+(const BigInt& a, const BigInt& b) { return add(a, b, b.negative); }
BigInt operator-(const BigInt& a, const BigInt& b) { return add(a, b, !b.negative); }
BigInt operator*(const BigInt& a, const BigInt& b) {
  BigInt r;
  r.negative = a.negative != b.negative;
  r.limb.assign(a.limb.size() + b.limb.size(), 0);
  for (size_t i = 0; i < a.limb.size(); ++i) {
    uint64_t carry = 0;
    for (size_t j = 0; j < b.limb.size() || carry; ++j) {
      const uint64_t p = j < b.limb.size() ? uint64_t{a.limb[i]} * b.limb[j] : 0;
      const uint64_t v = p + r.limb[i + j] + carry;
      r.limb[i + j] = static_cast<uint32_t>(v);
      carry = v >> 32;
    }
  }
  r.trim();
  return r;
}

BigInt scaled(double x) {
  int e = 0;
  const double m = std::frexp(x, &e);  // m 2^53 is an integer
  BigInt r(static_cast<long long>(std::ldexp(m, 53)));
  int shift = e - 53 + 160;
  for (; shift >= 30; shift -= 30) r = r * BigInt(1ll << 30);
  return r * BigInt(1ll << shift);
}

BigVec operator-(const BigVec& a, const BigVec& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
namespace {
BigVec scaled_point(const Coordinates& a) { return {scaled(a.x), scaled(a.y), scaled(a.z)}; }
}  // namespace
BigInt det2(const BigInt& a, const BigInt& b, const BigInt& c, const BigInt& d) { return a * d - b * c; }
BigInt det3(const BigVec& u, const BigVec& v, const BigVec& w) {
  return u.x * det2(v.y, v.z, w.y, w.z) - u.y * det2(v.x, v.z, w.x, w.z) + u.z * det2(v.x, v.y, w.x, w.y);
}
int orientation(double ax, double ay, double bx, double by, double cx, double cy) {
  const BigInt x = scaled(ax), y = scaled(ay);
  return det2(scaled(bx) - x, scaled(by) - y, scaled(cx) - x, scaled(cy) - y).sign();
}
int orientation(const Coordinates& a, const Coordinates& b, const Coordinates& c, const Coordinates& d) {
  const BigVec o = scaled_point(a);
  return det3(scaled_point(b) - o, scaled_point(c) - o, scaled_point(d) - o).sign();
}

}  // namespace big_int
