// SPDX-License-Identifier: MIT
// projection: faces seen along an axis or aslant, with certain answers only, for the proofs of detection (section 3).
// Along an axis no coordinate is rounded; for other directions detect/cull_faces.h bounds the rounding.
#pragma once

#include "mesh/half_edges.h"

namespace tpa {

struct View {
  int x, y, z;  // axes of space; z is the direction of sight
  int up;       // 1 if faces with the given normal turn counter-clockwise, else -1
};

// Along the axis with the largest part of the normal, so that faces with about this normal look as large as possible.
View view_along(const Vec3& normal);

struct Range {
  f64 low, high;
};
inline Range range_of(const f64 (&at)[3]) {
  return {min_of(at[0], min_of(at[1], at[2])), max_of(at[0], max_of(at[1], at[2]))};
}
inline bool is_apart(const Range& a, const Range& b) { return (a.high < b.low) | (b.high < a.low); }
inline Range united(const Range& a, const Range& b) { return {min_of(a.low, b.low), max_of(a.high, b.high)}; }

struct Point {
  f64 x, y;
};

// A face as seen.
struct Seen {
  f64 x[3], y[3];    // the corners
  Range in_x, in_y;  // certain bounds
  f64 doubt;         // bounds the error of turns
};
// Bounds the error of a turn of points within in_x and in_y, if coordinates are off by at most pad / 4. With u half an
// ulp of 1, and w the sum of width and height, w > 3 pad, the error is less than (2 pad + 2 u w) w. Twice that.
inline f64 doubt_of(const Seen& s, f64 pad) {
  const f64 w = (s.in_x.high - s.in_x.low) + (s.in_y.high - s.in_y.low);
  return 4 * (pad + 0x1p-53 * w) * w;
}
inline Seen seen(const View& w, const Mesh& m, const u32* corner) {
  static_assert(sizeof(Vec3) == 3 * sizeof(f64));
  const f64* coordinate = reinterpret_cast<const f64*>(m.position);
  Seen s;
  for (u32 i = 0; i < 3; ++i) {
    const f64* at = coordinate + 3 * static_cast<size_t>(corner[i]);
    s.x[i] = at[w.x], s.y[i] = at[w.y];
  }
  s.in_x = range_of(s.x), s.in_y = range_of(s.y);
  s.doubt = doubt_of(s, 0);
  return s;
}

// The side of a point, within the bounds, of the edge that begins at a corner. For a face that faces up: 1 inside, -1
// outside. 0: not certain.
inline int turn_of(const View& w, const Seen& s, u32 corner, const Point& p) {
  const u32 next = (corner + 1) % 3;
  const f64 turn = (s.x[next] - s.x[corner]) * (p.y - s.y[corner]) - (s.y[next] - s.y[corner]) * (p.x - s.x[corner]);
  return w.up * ((turn > s.doubt) - (turn < -s.doubt));
}
// True is certain.
inline bool faces_up(const View& w, const Seen& s) { return turn_of(w, s, 0, {s.x[2], s.y[2]}) > 0; }
inline bool is_off(const View& w, const Seen& s, const Point& p) {
  return is_apart(s.in_x, {p.x, p.x}) || is_apart(s.in_y, {p.y, p.y}) || turn_of(w, s, 0, p) < 0 ||
         turn_of(w, s, 1, p) < 0 || turn_of(w, s, 2, p) < 0;
}

// Twice the area of a triangle as seen, with a sign for its turn, and a bound of the error. The error is at most four
// roundings of the sum of both terms' absolute values; the bound has room for sums and comparisons after it.
struct Turn {
  f64 value, doubt;
};
inline Turn turn_between(const Point& a, const Point& b, const Point& p) {
  const f64 one = (b.x - a.x) * (p.y - a.y), other = (b.y - a.y) * (p.x - a.x);
  return {one - other, 0x1p-50 * (abs_of(one) + abs_of(other))};
}
// 1 or -1 is certain.
inline int certain_sign(const Turn& t) { return (t.value > t.doubt) - (t.value < -t.doubt); }

// A point on the face, near its middle.
inline Point middle_of(const Seen& s) {
  return {1.0 / 3 * (s.x[0] + s.x[1] + s.x[2]), 1.0 / 3 * (s.y[0] + s.y[1] + s.y[2])};
}

}  // namespace tpa
