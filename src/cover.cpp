#include "cover.h"

#include "predicates.h"

namespace tpa {

namespace {

// The slab may reach beyond the trial faces by their width and depth: neighbours as large as the faces that slope by
// one in one, as the steepest that a view along an axis may show nearly do (tan 54.7 degrees), stay within.
constexpr f64 margin_by_width = 1;

struct View {
  int x, y, z;  // z is the axis looked along
  int up;       // 1 or -1: which way the faces turn
};

struct Corners {
  Vec3 p[3];
};
Corners corners_of(const Mesh& m, const u32* v) { return {{m.position[v[0]], m.position[v[1]], m.position[v[2]]}}; }

struct Range {
  f64 low, high;
};
Range range_of(const Corners& c, int axis) {
  const f64 a = c.p[0][axis], b = c.p[1][axis], d = c.p[2][axis];
  return {min_of(a, min_of(b, d)), max_of(a, max_of(b, d))};
}
bool is_apart(const Range& a, const Range& b) { return (a.high < b.low) | (b.high < a.low); }
Range united(const Range& a, const Range& b) { return {min_of(a.low, b.low), max_of(a.high, b.high)}; }

// The axis along which the area of the trial faces is seen largest.
View view_of(const Mesh& m, const Trial* trials, u32 n) {
  Vec3 sum;
  for (u32 i = 0; i < n; ++i) sum = sum + normal_of(m, trials[i]);
  const f64 x = abs_of(sum.x), y = abs_of(sum.y), z = abs_of(sum.z);
  const int axis = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
  return {(axis + 1) % 3, (axis + 2) % 3, axis, sum[axis] < 0 ? -1 : 1};
}

// Certain signs only: orient2d() without what it does where rounding may decide.
int certain_turn(const View& w, const Vec3& a, const Vec3& b, f64 x, f64 y) {
  const f64 left = (b[w.x] - a[w.x]) * (y - a[w.y]), right = (b[w.y] - a[w.y]) * (x - a[w.x]);
  const f64 bound = 5 * 0x1p-53 * (abs_of(left) + abs_of(right));
  return w.up * ((left - right > bound) - (left - right < -bound));
}

bool faces_up(const View& w, const Corners& c) { return certain_turn(w, c.p[0], c.p[1], c.p[2][w.x], c.p[2][w.y]) > 0; }

struct Point {
  f64 x, y;
};

// Is the point certainly not on the face as seen?
bool is_off(const View& w, const Corners& c, const Point& p) {
  return certain_turn(w, c.p[0], c.p[1], p.x, p.y) < 0 || certain_turn(w, c.p[1], c.p[2], p.x, p.y) < 0 ||
         certain_turn(w, c.p[2], c.p[0], p.x, p.y) < 0;
}

// Faces over the rectangle: their heights, and whether one does not certainly face up, or may cover the point.
constexpr u32 most_over = 64;
struct Over {
  u32 count = 0;
  Range height[most_over];
  bool covers[most_over];
};

// Extends the slab until none of the faces leaves it; false where one of those in it breaks the proof.
bool grow_slab(Over& over, Range& slab) {
  for (u32 i = 0; i < over.count;) {
    if (is_apart(over.height[i], slab)) {
      ++i;
      continue;
    }
    if (over.covers[i]) return false;
    const Range grown = united(slab, over.height[i]);
    const bool grows = grown.low < slab.low || grown.high > slab.high;
    slab = grown;
    over.height[i] = over.height[--over.count], over.covers[i] = over.covers[over.count];
    if (grows) i = 0;
  }
  return true;
}

}  // namespace

Vec3 normal_of(const Mesh& m, const Trial& t) {
  return area_normal(m.position[t.v[0]], m.position[t.v[1]], m.position[t.v[2]]);
}

bool covers_once(const Mesh& m, const Grid& g, const u8* going, const Trial* trials, u32 n) {
  const View w = view_of(m, trials, n);
  const Corners first = corners_of(m, trials[0].v);
  Range x = range_of(first, w.x), y = range_of(first, w.y), z = range_of(first, w.z);
  // A point within the first face. Not exactly in the middle, but any point will do.
  const Point p = {1.0 / 3 * (first.p[0][w.x] + first.p[1][w.x] + first.p[2][w.x]),
                   1.0 / 3 * (first.p[0][w.y] + first.p[1][w.y] + first.p[2][w.y])};
  if (!faces_up(w, first)) return false;
  for (u32 i = 1; i < n; ++i) {
    const Corners c = corners_of(m, trials[i].v);
    if (!faces_up(w, c) || !is_off(w, c, p)) return false;
    x = united(x, range_of(c, w.x)), y = united(y, range_of(c, w.y)), z = united(z, range_of(c, w.z));
  }
  if (!(x.low < p.x && p.x < x.high && y.low < p.y && p.y < y.high)) return false;
  // From the slab of the trial faces on, to one that no face over the rectangle leaves.
  const f64 margin = margin_by_width * ((x.high - x.low) + (y.high - y.low));
  const Range reach = {z.low - margin, z.high + margin};
  Over over;
  const auto survey = [&](u32 f) {
    const Corners c = corners_of(m, m.corner + 3 * static_cast<size_t>(f));
    const Range fx = range_of(c, w.x), fy = range_of(c, w.y);
    if (is_apart(fx, x) || is_apart(fy, y)) return false;
    if (over.count == most_over) return true;
    over.height[over.count] = range_of(c, w.z);
    over.covers[over.count++] =
        !faces_up(w, c) || (!is_apart(fx, {p.x, p.x}) && !is_apart(fy, {p.y, p.y}) && !is_off(w, c, p));
    return false;
  };
  Vec3 low, high;
  low[w.x] = x.low, low[w.y] = y.low, low[w.z] = reach.low;
  high[w.x] = x.high, high[w.y] = y.high, high[w.z] = reach.high;
  if (find_near(g, box_of(low, high, high), [&](u32 f) { return going[f] == 0; }, survey) != none) return false;
  return grow_slab(over, z) && reach.low <= z.low && z.high <= reach.high;
}

}  // namespace tpa
