// SPDX-License-Identifier: MIT
#include "geometry/near_triangle.h"

namespace tpa {

namespace {

f64 squared_distance_to_edge(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 along = b - a, to = p - a;
  const f64 size = squared_length(along);
  const f64 share = size > 0 ? max_of(0.0, min_of(1.0, dot(to, along) / size)) : 0;
  return squared_length(to - share * along);
}

}  // namespace

f64 squared_distance(const Vec3& p, const Triangle& t) {
  const Vec3 normal = area_normal(t[0], t[1], t[2]);
  bool is_above = squared_length(normal) > 0;
  for (u32 i = 0; i < 3; ++i) {
    const Vec3& a = t[i];
    is_above = is_above && dot(cross(normal, t[(i + 1) % 3] - a), p - a) >= 0;
  }
  if (is_above) {
    const f64 height = dot(normal, p - t[0]);
    return height * height / squared_length(normal);
  }
  f64 nearest = no_way;
  for (u32 i = 0; i < 3; ++i) nearest = min_of(nearest, squared_distance_to_edge(p, t[i], t[(i + 1) % 3]));
  return nearest;
}

}  // namespace tpa
