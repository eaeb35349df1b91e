// SPDX-License-Identifier: MIT
#include "geometry/kd_tree.h"

#include "base/sort.h"

namespace tpa {

namespace {

// A range of the order; the point in the middle divides the range along the axis.
struct PointRange {
  u32 first, last;
  int axis;
  u32 middle() const { return first + (last - first) / 2; }
  PointRange below() const { return {first, middle(), (axis + 1) % 3}; }
  PointRange above() const { return {middle() + 1, last, (axis + 1) % 3}; }
};

// A depth-first walk over halves of halves keeps a range waiting on each of 32 levels, and two on the last.
constexpr u32 most_ranges = 34;

}  // namespace

void build(KdTree& t) {
  for (u32 i = 0; i < t.count; ++i) t.order[i] = i;
  PointRange waiting[most_ranges] = {{0, t.count, 0}};
  for (u32 n = 1; n > 0;) {
    const PointRange r = waiting[--n];
    if (r.last - r.first < 2) continue;
    sort_in_place(t.order + r.first, r.last - r.first, [&](u32 a, u32 b) {
      const f64 p = t.point[a][r.axis], q = t.point[b][r.axis];
      return p != q ? p < q : a < b;
    });
    waiting[n++] = r.above();
    waiting[n++] = r.below();
  }
}

void point_tree_detail::search(const KdTree& t, const Vec3& p, const f64& squared_reach, const PointVisitor& visitor) {
  struct Waiting {
    PointRange range;
    f64 away;  // squared distance at least
  };
  Waiting waiting[most_ranges] = {{{0, t.count, 0}, 0}};
  for (u32 n = 1; n > 0;) {
    const auto [r, away] = waiting[--n];
    if (r.first == r.last || away > squared_reach) continue;
    const u32 i = t.order[r.middle()];
    const f64 beyond = p[r.axis] - t.point[i][r.axis];
    waiting[n++] = {beyond < 0 ? r.above() : r.below(), max_of(away, beyond * beyond)};
    waiting[n++] = {beyond < 0 ? r.below() : r.above(), away};
    if (squared_length(t.point[i] - p) <= squared_reach) visitor.visit(visitor.caller, i);
  }
}

}  // namespace tpa
