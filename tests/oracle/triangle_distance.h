// SPDX-License-Identifier: MIT
// triangle_distance: the squared distance from a point to a triangle, in doubles.
#pragma once

#include <algorithm>

#include "support/point.h"

namespace support {

inline double SquaredDistanceToSegment(const Point& p, const Point& a, const Point& b) {
  const Point d = Difference(b, a), w = Difference(p, a);
  const double length = Dot(d, d), t = length > 0 ? std::clamp(Dot(w, d) / length, 0.0, 1.0) : 0;
  const Point q = Difference(w, Scaled(t, d));
  return Dot(q, q);
}

inline double SquaredDistanceToTriangle(const Point& at, const Point (&p)[3]) {
  const Point u = Difference(p[1], p[0]), v = Difference(p[2], p[0]), w = Difference(at, p[0]);
  const double uu = Dot(u, u), uv = Dot(u, v), vv = Dot(v, v), wu = Dot(w, u), wv = Dot(w, v);
  const double area = uu * vv - uv * uv, s = wu * vv - wv * uv, t = wv * uu - wu * uv;
  if (s >= 0 && t >= 0 && s + t <= area && area > 0) return Dot(w, w) - (s * wu + t * wv) / area;
  return std::min({SquaredDistanceToSegment(at, p[0], p[1]), SquaredDistanceToSegment(at, p[1], p[2]),
                   SquaredDistanceToSegment(at, p[2], p[0])});
}

}  // namespace support
