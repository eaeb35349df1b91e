// SPDX-License-Identifier: MIT
#include "detect/trial_fences.h"

namespace tpa {

namespace {

constexpr u64 turns_for_unit = 16;

// Trial corners as seen.
struct SeenCorners {
  const View& view;
  const Mesh& m;
  const TrialCorners& corners;

  u32 count() const { return corners.count; }
  const Vec3& place(u32 i) const { return m.position[corners.vertex[i]]; }
  Point operator[](u32 i) const { return {place(i)[view.x], place(i)[view.y]}; }
  Fence fence(u32 i, u32 k) const { return {corners.vertex[i], corners.vertex[k], (*this)[i], (*this)[k], 0}; }
};

// Larger turns lie further beyond.
Turn turn_beyond(const Fence& f, const Point& p) { return turn_between(f.from, f.to, p); }

f64 squared_distance(const Point& a, const Point& b) {
  const f64 x = b.x - a.x, y = b.y - a.y;
  return x * x + y * y;
}
f64 squared_length(const Fence& f) { return squared_distance(f.from, f.to); }

void collect_corners(TrialCorners& corners, const FaceCorners* trials, u64 set) {
  corners.count = 0;
  for (; set != 0; set &= set - 1)
    for (u32 v : trials[__builtin_ctzll(set)].v) {
      u32 i = 0;
      while (i < corners.count && corners.vertex[i] != v) ++i;
      if (i < corners.count) continue;
      if (i == TrialCorners::most) {
        corners.count = 0;
        return;
      }
      corners.vertex[corners.count++] = v;
    }
}

// The longest fences stay, the longest first.
void keep_fence(TrialFences& s, const Fence& f) {
  u32 at = s.count;
  while (at > 0 && squared_length(s.fence[at - 1]) < squared_length(f)) --at;
  if (at == TrialFences::most) return;
  s.count = min_of(s.count + 1, TrialFences::most);
  for (u32 i = s.count; --i > at;) s.fence[i] = s.fence[i - 1];
  s.fence[at] = f;
}

u32 leftmost(const SeenCorners& c) {
  u32 best = 0;
  for (u32 i = 1; i < c.count(); ++i)
    if (c[i].x < c[best].x || (c[i].x == c[best].x && c[i].y < c[best].y)) best = i;
  return best;
}

// The next corner of the convex hull, the farther one of two on a line.
u32 next_of_hull(const SeenCorners& c, u32 at) {
  const Point from = c[at];
  u32 next = at == 0 ? 1 : 0;
  Point to = c[next];
  for (u32 i = next + 1; i < c.count(); ++i) {
    const Point p = c[i];
    const f64 turn = turn_between(from, to, p).value;
    if (i == at || turn < 0 || (turn == 0 && squared_distance(from, p) <= squared_distance(from, to))) continue;
    next = i;
    to = p;
  }
  return next;
}

// Jarvis 1973. Rounding may lead the walk astray; find_farthest() makes any fence right.
void walk_hull(TrialFences& s, const SeenCorners& c) {
  const u32 first = leftmost(c);
  for (u32 at = first, sides = 0; sides < c.count(); ++sides) {
    const u32 next = next_of_hull(c, at);
    keep_fence(s, c.fence(at, next));
    at = next;
    if (at == first) return;
  }
}

void find_farthest(const SeenCorners& c, Fence& f) {
  const u32 a = f.a, b = f.b;
  for (u32 i = 0; i < c.count(); ++i) {
    const u32 v = c.corners.vertex[i];
    const Turn turn = turn_beyond(f, c[i]);
    if (v == a || v == b || turn.value < -turn.doubt) continue;
    f.farthest = max_of(f.farthest, turn.value + turn.doubt);
    f.a = f.b = none;
  }
}

// Any direction will do, whatever its error, since trial corners and boxes are measured along the same one. Bounds of
// boxes are off by 2^-23 at most, and so by less than 2^-21 times the largest component along a direction. The rounding
// of doubles is far less.
constexpr f64 doubt_along = 0x1p-19;

void add_extent(TrialFences& s, const SeenCorners& c, const Frame& frame, const Vec3& axis) {
  TrialExtent& e = s.extent[s.extents++];
  e = {axis, {abs_of(axis.x), abs_of(axis.y), abs_of(axis.z)}, no_way, -no_way};
  for (u32 i = 0; i < c.count(); ++i) {
    const f64 at = dot(axis, frame.scale * (c.place(i) - frame.middle));
    e.low = min_of(e.low, at), e.high = max_of(e.high, at);
  }
  const f64 doubt = doubt_along * max_of(e.size.x, max_of(e.size.y, e.size.z));
  e.low -= doubt, e.high += doubt;
}

Vec3 square_to(const View& view, const Fence& f) {
  Vec3 axis;
  axis[view.x] = f.from.y - f.to.y, axis[view.y] = f.to.x - f.from.x;
  return axis;
}

bool is_any_too_far(const SeenCorners& c, const Frame& frame) {
  for (u32 i = 0; i < c.count(); ++i)
    if (is_beyond(frame, c.place(i))) return true;
  return false;
}

}  // namespace

void make_fences(TrialFences& s, TrialCorners& corners, const Mesh& m, const NearFaces& g, const FaceCorners* trials,
                 u64 set, const Vec3& normal) {
  s.view = view_along(normal);
  s.count = s.extents = 0;
  collect_corners(corners, trials, set);
  if (corners.count == 0) return;
  spend(g.meter, u64{corners.count} * corners.count / turns_for_unit);
  const SeenCorners c{s.view, m, corners};
  walk_hull(s, c);
  for (u32 i = 0; i < s.count; ++i) find_farthest(c, s.fence[i]);
  const Frame& frame = g.tree->frame;
  if (is_any_too_far(c, frame)) return;
  for (u32 i = 0; i < s.count; ++i) add_extent(s, c, frame, square_to(s.view, s.fence[i]));
  add_extent(s, c, frame, normal);
}

bool is_beyond_fence(const TrialFences& s, const Mesh& m, const u32* corner) {
  const auto is_beyond = [&](const Fence& f, u32 v) {
    if (v == f.a || v == f.b) return true;
    const Turn turn = turn_beyond(f, {m.position[v][s.view.x], m.position[v][s.view.y]});
    return turn.value > f.farthest + turn.doubt;
  };
  for (u32 i = 0; i < s.count; ++i) {
    const Fence& f = s.fence[i];
    if (is_beyond(f, corner[0]) && is_beyond(f, corner[1]) && is_beyond(f, corner[2])) return true;
  }
  return false;
}

bool is_box_beyond(const TrialFences& s, const Box& box) {
  Vec3 middle, half;
  for (int k = 0; k < 3; ++k) {
    const f64 low = static_cast<f64>(box.low[k]), high = static_cast<f64>(box.high[k]);
    middle[k] = 0.5 * (low + high), half[k] = 0.5 * (high - low);
  }
  for (u32 i = 0; i < s.extents; ++i) {
    const TrialExtent& e = s.extent[i];
    const f64 at = dot(e.axis, middle), reach = dot(e.size, half);
    if (at - reach > e.high || at + reach < e.low) return true;
  }
  return false;
}

}  // namespace tpa
