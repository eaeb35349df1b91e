// view: faces looked at along an axis. No coordinate is rounded by that, so which way a face turns is as certain as a
// sign of orient2d.
#pragma once

#include "mesh.h"

namespace tpa {

struct View {
  int x, y, z;  // z is the axis looked along
  int up;       // 1 or -1: which way the faces turn
};

// Along the axis in which a normal is largest, so that faces with about that normal are seen as large as they can be.
View view_along(const Vec3& normal);

// A face as it is seen.
struct Seen {
  f64 x[3], y[3];
};
inline Seen seen(const View& w, const Mesh& m, const u32* corner) {
  static_assert(sizeof(Vec3) == 3 * sizeof(f64));
  const f64* coordinate = reinterpret_cast<const f64*>(m.position);
  Seen s;
  for (u32 i = 0; i < 3; ++i) {
    const f64* at = coordinate + 3 * static_cast<size_t>(corner[i]);
    s.x[i] = at[w.x], s.y[i] = at[w.y];
  }
  return s;
}
inline Seen seen(const View& w, const Mesh& m, u32 f) { return seen(w, m, m.corner + 3 * static_cast<size_t>(f)); }

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

// Which way the point is from the edge that begins at a corner. Certain signs only: orient2d() without what it does
// where rounding may decide.
inline int certain_turn(const View& w, const Seen& s, u32 corner, const Point& p) {
  const u32 next = (corner + 1) % 3;
  const f64 left = (s.x[next] - s.x[corner]) * (p.y - s.y[corner]),
            right = (s.y[next] - s.y[corner]) * (p.x - s.x[corner]);
  const f64 bound = 5 * 0x1p-53 * (abs_of(left) + abs_of(right));
  return w.up * ((left - right > bound) - (left - right < -bound));
}

inline bool faces_up(const View& w, const Seen& s) { return certain_turn(w, s, 0, {s.x[2], s.y[2]}) > 0; }

// A point on the face. Not exactly in the middle, but any point will do.
inline Point middle_of(const Seen& s) {
  return {1.0 / 3 * (s.x[0] + s.x[1] + s.x[2]), 1.0 / 3 * (s.y[0] + s.y[1] + s.y[2])};
}

// Is the point certainly not on the face?
bool is_off(const View& w, const Seen& s, const Point& p);

}  // namespace tpa
