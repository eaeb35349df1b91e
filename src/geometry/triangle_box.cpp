// SPDX-License-Identifier: MIT
#include "geometry/triangle_box.h"

#include "base/vec3.h"

namespace tpa {

namespace {

// Any direction will do, whatever its error. Points off by 2^-23 along each axis have places along the direction off by
// less than 2^-21 times the largest component, and so have the bounds. The rounding of doubles is far less.
constexpr f64 doubt_along = 0x1p-19;

// The triangle relative to the middle of the box, and half the sides of the box.
struct InBox {
  Vec3 corner[3], half;
};

InBox in_box(const FlatTriangle& t, const Box& b) {
  InBox x;
  for (int k = 0; k < 3; ++k) {
    const f64 low = static_cast<f64>(b.low[k]), high = static_cast<f64>(b.high[k]);
    x.half[k] = 0.5 * (high - low);
    for (u32 i = 0; i < 3; ++i) x.corner[i][k] = static_cast<f64>(t.corner[i][k]) - 0.5 * (low + high);
  }
  return x;
}

bool is_off_along(const InBox& x, const Vec3& axis) {
  const Vec3 size = {abs_of(axis.x), abs_of(axis.y), abs_of(axis.z)};
  const f64 a = dot(axis, x.corner[0]), b = dot(axis, x.corner[1]), c = dot(axis, x.corner[2]);
  const f64 reach = dot(size, x.half) + doubt_along * max_of(size.x, max_of(size.y, size.z));
  return min_of(a, min_of(b, c)) > reach || max_of(a, max_of(b, c)) < -reach;
}

}  // namespace

bool provably_off(const FlatTriangle& t, const Box& b) {
  const InBox x = in_box(t, b);
  const Vec3 edge[] = {x.corner[1] - x.corner[0], x.corner[2] - x.corner[1], x.corner[0] - x.corner[2]};
  if (is_off_along(x, {1, 0, 0}) || is_off_along(x, {0, 1, 0}) || is_off_along(x, {0, 0, 1})) return true;
  if (is_off_along(x, cross(edge[0], edge[1]))) return true;
  for (const Vec3& e : edge)
    if (is_off_along(x, {0, e.z, -e.y}) || is_off_along(x, {-e.z, 0, e.x}) || is_off_along(x, {e.y, -e.x, 0}))
      return true;
  return false;
}

}  // namespace tpa
