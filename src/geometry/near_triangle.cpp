// SPDX-License-Identifier: MIT
#include "geometry/near_triangle.h"

namespace tpa {

namespace {

// The square of the distance from the point at a share `part` of `whole` along an edge; `to` leads from its start to p.
f64 squared_distance_along(const Vec3& to, const Vec3& edge, f64 part, f64 whole) {
  return squared_length(to - (whole > 0 ? part / whole : 0) * edge);
}

}  // namespace

// By the region of the triangle's plane that the point lies above (Ericson 2005, section 5.1.5). An edge without length
// leaves its region to the other edges.
f64 squared_distance(const Vec3& p, const Triangle& t) {
  const Vec3 ab = t[1] - t[0], ac = t[2] - t[0], bc = t[2] - t[1];
  const Vec3 from_a = p - t[0], from_b = p - t[1], from_c = p - t[2];
  const f64 a_b = dot(ab, from_a), a_c = dot(ac, from_a);
  if (a_b <= 0 && a_c <= 0) return squared_length(from_a);
  const f64 b_b = dot(ab, from_b), b_c = dot(ac, from_b);
  if (b_b >= 0 && b_c <= b_b) return squared_length(from_b);
  const f64 c_b = dot(ab, from_c), c_c = dot(ac, from_c);
  if (c_c >= 0 && c_b <= c_c) return squared_length(from_c);
  const f64 above_ab = a_b * b_c - b_b * a_c, above_ac = c_b * a_c - a_b * c_c, above_bc = b_b * c_c - c_b * b_c;
  if (above_ab <= 0 && a_b >= 0 && b_b <= 0 && a_b > b_b) return squared_distance_along(from_a, ab, a_b, a_b - b_b);
  if (above_ac <= 0 && a_c >= 0 && c_c <= 0 && a_c > c_c) return squared_distance_along(from_a, ac, a_c, a_c - c_c);
  const f64 to_c = b_c - b_b, to_b = c_b - c_c;
  if (above_bc <= 0 && to_c >= 0 && to_b >= 0) return squared_distance_along(from_b, bc, to_c, to_c + to_b);
  // Shares of no less than 0 keep the nearest point of a sliver within it.
  const f64 of_b = max_of(0.0, above_ac), of_c = max_of(0.0, above_ab), whole = max_of(0.0, above_bc) + of_b + of_c;
  if (!(whole > 0)) return min_of(squared_length(from_a), min_of(squared_length(from_b), squared_length(from_c)));
  return squared_length(from_a - (of_b / whole) * ab - (of_c / whole) * ac);
}

}  // namespace tpa
