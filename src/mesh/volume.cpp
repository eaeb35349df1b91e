// SPDX-License-Identifier: MIT
#include "mesh/volume.h"

namespace tpa {

namespace {

// Each of the six terms of a product of three differences has at most eight roundings, and the terms add up to at most
// the product of the sizes. Twice the sum, since roundings multiply.
constexpr f64 doubt_of_product = 16 * 0x1p-53, doubt_of_sum = 0x1p-52;

}  // namespace

void add(SignedVolume& s, const SignedVolume& change) {
  s.sum += change.sum;
  s.doubt += change.doubt + doubt_of_sum * abs_of(s.sum);
}

void add(SignedVolume& s, f64 sign, const Vec3& from, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = a - from, v = b - from, w = c - from;
  add(s, {sign * dot(u, cross(v, w)), doubt_of_product * (size_of(u) * size_of(v) * size_of(w))});
}

void add_faces_above(SignedVolume& s, const Mesh& m, const Vec3& from, u32 v) {
  for_each_outgoing(m, v, [&](u32 h) {
    const u32 a = head(m, h), b = apex(m, h);
    if (v < a && v < b) add(s, 1, from, m.position[v], m.position[a], m.position[b]);
  });
}

}  // namespace tpa
