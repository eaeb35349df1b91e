// SPDX-License-Identifier: MIT
#include "geometry/constructed_point.h"

#include "geometry/expansion.h"

namespace tpa {

namespace {

struct ExactVector {
  Dyadic<1> at[3];
};

// Most differences of coordinates are doubles.
Dyadic<1> difference(f64 a, f64 b) {
  const ExactPair pair = two_sum(a, -b);
  return pair.low == 0 ? dyadic(pair.high) : dyadic(pair.high) + dyadic(pair.low);
}
ExactVector difference(const Vec3& a, const Vec3& b) {
  return {{difference(a.x, b.x), difference(a.y, b.y), difference(a.z, b.z)}};
}

template <u32 D, u32 E>
Dyadic<D + E> minor_of(const Dyadic<D>& a, const Dyadic<E>& b, const Dyadic<E>& c, const Dyadic<D>& d) {
  return a * b - c * d;
}

template <u32 D>
Dyadic<D + 1> dot(const Dyadic<D> (&n)[3], const ExactVector& v) {
  return n[0] * v.at[0] + n[1] * v.at[1] + n[2] * v.at[2];
}

// The same number as a polynomial of higher degree.
template <u32 D, u32 E>
void widen(const Dyadic<E>& a, Dyadic<D>& out) {
  static_assert(E <= D);
  out.sign = a.sign;
  out.low = a.low;
  out.size = a.size;
  for (u32 i = 0; i < a.size; ++i) out.limb[i] = a.limb[i];
}

constexpr u32 after(u32 axis) { return axis == 2 ? 0 : axis + 1; }

}  // namespace

ExactPlane exact_plane(const Vec3& a, const Vec3& b, const Vec3& c) {
  const ExactVector u = difference(b, a), v = difference(c, a);
  ExactPlane plane;
  plane.at = a;
  for (u32 i = 0; i < 3; ++i) {
    const u32 j = after(i), k = after(j);
    plane.normal[i] = minor_of(u.at[j], v.at[k], u.at[k], v.at[j]);
  }
  return plane;
}

ExactPlane exact_plane_along(const Vec3& a, const Vec3& b, u32 axis) {
  const ExactVector u = difference(b, a);
  const u32 j = after(axis), k = after(j);
  ExactPlane plane;
  plane.at = a;
  widen(dyadic(0.0), plane.normal[axis]);
  widen(u.at[k], plane.normal[j]);
  widen(dyadic(0.0) - u.at[j], plane.normal[k]);
  return plane;
}

ExactPoint exact_point(const Vec3& p) {
  ExactPoint out;
  widen(dyadic(p.x), out.x[0]);
  widen(dyadic(p.y), out.x[1]);
  widen(dyadic(p.z), out.x[2]);
  widen(dyadic(1.0), out.w);
  return out;
}

// a + t (b - a) with t = normal . (at - a) / normal . (b - a).
ExactPoint line_through_plane(const Vec3& a, const Vec3& b, const ExactPlane& plane) {
  const ExactVector way = difference(b, a);
  const Dyadic<3> above = dot(plane.normal, difference(plane.at, a)), slope = dot(plane.normal, way);
  ExactPoint out;
  for (u32 i = 0; i < 3; ++i) widen(dyadic(a[static_cast<int>(i)]) * slope + way.at[i] * above, out.x[i]);
  widen(slope, out.w);
  return out;
}

// Cramer's rule, with the origin moved to a.at.
ExactPoint common_point(const ExactPlane& a, const ExactPlane& b, const ExactPlane& c) {
  const Dyadic<3> level_b = dot(b.normal, difference(b.at, a.at)), level_c = dot(c.normal, difference(c.at, a.at));
  ExactPoint out;
  widen(dyadic(0.0), out.w);
  for (u32 i = 0; i < 3; ++i) {
    const u32 j = after(i), k = after(j);
    out.w = out.w + a.normal[i] * minor_of(b.normal[j], c.normal[k], b.normal[k], c.normal[j]);
    out.x[i] = level_b * minor_of(c.normal[j], a.normal[k], c.normal[k], a.normal[j]) +
               level_c * minor_of(a.normal[j], b.normal[k], a.normal[k], b.normal[j]);
  }
  for (u32 i = 0; i < 3; ++i) out.x[i] = out.x[i] + dyadic(a.at[static_cast<int>(i)]) * out.w;
  return out;
}

Vec3 rounded(const ExactPoint& p, u32& exact) {
  bool is_exact[3];
  const Vec3 at{rounded_quotient(p.x[0], p.w, is_exact[0]), rounded_quotient(p.x[1], p.w, is_exact[1]),
                rounded_quotient(p.x[2], p.w, is_exact[2])};
  exact = (is_exact[0] ? 1u : 0u) | (is_exact[1] ? 2u : 0u) | (is_exact[2] ? 4u : 0u);
  return at;
}

int compare_along(u32 axis, const ExactPoint& p, const ExactPoint& q) {
  return sign_of(p.x[axis] * q.w - q.x[axis] * p.w) * sign_of(p.w) * sign_of(q.w);
}

bool equal(const ExactPoint& p, const ExactPoint& q) {
  for (u32 axis = 0; axis < 3; ++axis)
    if (compare_along(axis, p, q) != 0) return false;
  return true;
}

int flat_orient(u32 axis, const ExactPoint& a, const ExactPoint& b, const ExactPoint& c) {
  const u32 u = after(axis), v = after(u);
  Dyadic<20> sum = minor_of(b.x[u], c.x[v], b.x[v], c.x[u]) * a.w;
  sum = sum - minor_of(a.x[u], c.x[v], a.x[v], c.x[u]) * b.w;
  sum = sum + minor_of(a.x[u], b.x[v], a.x[v], b.x[u]) * c.w;
  return sign_of(sum) * sign_of(a.w) * sign_of(b.w) * sign_of(c.w);
}

int cross_sign(u32 axis, const ExactPlane& a, const ExactPlane& b) {
  const u32 j = after(axis), k = after(j);
  return sign_of(minor_of(a.normal[j], b.normal[k], a.normal[k], b.normal[j]));
}

int dot_sign(const ExactPlane& a, const ExactPlane& b) {
  return sign_of(a.normal[0] * b.normal[0] + a.normal[1] * b.normal[1] + a.normal[2] * b.normal[2]);
}

// The crossing of a plane with the line is at[axis] + (n[j] (at[j] - p[j]) + n[k] (at[k] - p[k])) / n[axis] along the
// axis.
int compare_heights(u32 axis, const Vec3& p, const ExactPlane& a, const ExactPlane& b) {
  const auto numerator = [&](const ExactPlane& plane) {
    const int i = static_cast<int>(axis);
    ExactVector way = difference(plane.at, p);
    way.at[axis] = dyadic(plane.at[i]);
    return dot(plane.normal, way);
  };
  return sign_of(numerator(a) * b.normal[axis] - numerator(b) * a.normal[axis]) * sign_of(a.normal[axis]) *
         sign_of(b.normal[axis]);
}

}  // namespace tpa
