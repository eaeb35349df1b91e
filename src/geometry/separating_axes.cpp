// SPDX-License-Identifier: MIT
#include "geometry/separating_axes.h"

namespace tpa {

namespace {

f64 largest_component(const Vec3& a) { return max_of(abs_of(a.x), max_of(abs_of(a.y), abs_of(a.z))); }

// Bound of |computed - true| for dot(axis, p - o) with |p - o| <= reach by components, as computed from a rounded
// difference: each of three terms carries four roundings at most (difference, product, two additions).
f64 projection_error(const Vec3& axis, f64 reach) { return 13 * 0x1p-53 * largest_component(axis) * reach; }

// Does the plane through o with normal `axis` (any vector: only the margin matters) leave more than the error between
// the projections of a and of b?
bool separates(const Vec3& axis, const Vec3 a[3], const Vec3 b[3], f64 reach) {
  f64 a_low = dot(axis, a[0]), a_high = a_low, b_low = dot(axis, b[0]), b_high = b_low;
  for (int i = 1; i < 3; ++i) {
    const f64 p = dot(axis, a[i]), q = dot(axis, b[i]);
    a_low = min_of(a_low, p);
    a_high = max_of(a_high, p);
    b_low = min_of(b_low, q);
    b_high = max_of(b_high, q);
  }
  const f64 margin = 2 * projection_error(axis, reach);
  return b_low - a_high > margin || a_low - b_high > margin;
}

bool edges_separate(const Vec3 a[3], const Vec3 b[3], f64 reach) {
  const Vec3 normal = area_normal(a[0], a[1], a[2]);
  for (int i = 0; i < 3; ++i)
    if (separates(cross(normal, a[(i + 1) % 3] - a[i]), a, b, reach)) return true;
  return false;
}

// A triangle that touches the plane of another beside it may leave a gap along such an axis only.
bool edge_products_separate(const Vec3 a[3], const Vec3 b[3], f64 reach) {
  for (u32 i = 0; i < 3; ++i)
    for (u32 k = 0; k < 3; ++k)
      if (separates(cross(a[(i + 1) % 3] - a[i], b[(k + 1) % 3] - b[k]), a, b, reach)) return true;
  return false;
}

Vec3 unit(const Vec3& a) {
  const f64 l = length(a);
  return l > 0 ? 1 / l * a : a;
}

}  // namespace

bool provably_apart(const Triangle& a, const Triangle& b) {
  const Vec3 o = a[0];
  Vec3 p[3], q[3];
  f64 reach = 0;
  for (u32 i = 0; i < 3; ++i) {
    p[i] = a[i] - o;
    q[i] = b[i] - o;
    reach = max_of(reach, max_of(largest_component(p[i]), largest_component(q[i])));
  }
  return edges_separate(p, q, reach) || edges_separate(q, p, reach) || edge_products_separate(p, q, reach);
}

// A plane through v with one triangle's other corners strictly before it and the other's strictly behind.
bool provably_apart_beyond_vertex(const Vec3& v, const Vec3& a1, const Vec3& a2, const Vec3& b1, const Vec3& b2) {
  const Vec3 p1 = a1 - v, p2 = a2 - v, q1 = b1 - v, q2 = b2 - v;
  const f64 reach = max_of(max_of(largest_component(p1), largest_component(p2)),
                           max_of(largest_component(q1), largest_component(q2)));
  const Vec3 axis = (unit(p1) + unit(p2)) - (unit(q1) + unit(q2));
  const f64 margin = projection_error(axis, reach);
  return dot(axis, p1) > margin && dot(axis, p2) > margin && dot(axis, q1) < -margin && dot(axis, q2) < -margin;
}

// Folded, the outward normals of the two triangles would be exactly opposite. The product of the normals carries at
// most 14 roundings in each of its terms; the terms are bounded by the components' magnitudes.
bool provably_apart_beyond_edge(const Vec3& u, const Vec3& v, const Vec3& oa, const Vec3& ob) {
  const Vec3 e = v - u, p = oa - u, q = ob - u;
  const f64 reach = max_of(largest_component(e), max_of(largest_component(p), largest_component(q)));
  const f64 product = dot(cross(e, p), cross(q, e));
  return product > 3 * 4 * 16 * 0x1p-53 * reach * reach * reach * reach;
}

}  // namespace tpa
