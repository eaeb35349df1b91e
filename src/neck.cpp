#include "neck.h"

#include "order.h"
#include "predicates.h"

namespace tpa {

namespace {

Vec3 middle_of_cut(const Mesh& m, const Regions& r, u32 cut) {
  const u32 h = r.cuts[cut].half_edge;
  return midpoint(m.position[tail(m, h)], m.position[head(m, h)]);
}

Vec3 middle_of_loop(const Mesh& m, const Regions& r, const CutLoop& loop) {
  Vec3 sum;
  for (u32 i = 0; i < loop.count; ++i) sum = sum + middle_of_cut(m, r, loop.first + i);
  return 1.0 / loop.count * sum;
}

// Twice the loop's area, as a vector along its axis.
Vec3 axis_of(const Mesh& m, const Regions& r, const CutLoop& loop, const Vec3& middle) {
  Vec3 sum;
  Vec3 before = middle_of_cut(m, r, loop.first + loop.count - 1) - middle;
  for (u32 i = 0; i < loop.count; ++i) {
    const Vec3 now = middle_of_cut(m, r, loop.first + i) - middle;
    sum = sum + cross(before, now);
    before = now;
  }
  return sum;
}

// How much of the loop's faces turns away from its axis: positive round a neck, negative round a hole.
f64 outward_share(const Mesh& m, const Regions& r, const CutLoop& loop, const Vec3& middle) {
  const Vec3 axis = axis_of(m, r, loop, middle);
  const f64 square = squared_length(axis);
  f64 sum = 0;
  for (u32 i = loop.first; i < loop.first + loop.count; ++i) {
    const u32 first = 3 * face_of(r.cuts[i].half_edge);
    const Vec3 from = middle_of_cut(m, r, i) - middle;
    const Vec3 away = square > 0 ? from - dot(from, axis) / square * axis : from;
    sum += dot(away, area_normal(corner_position(m, first), corner_position(m, first + 1), corner_position(m, first + 2)));
  }
  return sum;
}

// Where faces cross the way from p to q, as shares of it, in order.
constexpr u32 most_crossings = 126;
struct Crossings {
  f64 at[most_crossings + 2];
  u32 count = 0;
  bool fits = true;
};
void find_crossings(const Mesh& m, const Grid& g, const Vec3& p, const Vec3& q, Crossings& found) {
  const auto add = [&](f64 at) {
    found.fits = found.fits && found.count < most_crossings + 2;
    if (found.fits) found.at[found.count++] = at;
  };
  add(0);
  add(1);
  for_each_near(g, box_of(p, q, q), [&](u32 f) {
    const Vec3 &a = corner_position(m, 3 * f), &b = corner_position(m, 3 * f + 1), &c = corner_position(m, 3 * f + 2);
    if (segment_through_triangle(p, q, a, b, c) == Passage::misses) return;
    const Vec3 normal = area_normal(a, b, c);
    const f64 from = abs_of(dot(normal, p - a)), to = abs_of(dot(normal, q - a));
    add(from + to > 0 ? from / (from + to) : 0);
  });
  if (found.fits) sort_in_place(found.at, found.count, [](f64 x, f64 y) { return x < y; });
}

// Between two crossings the winding number is the same all along. What is crossed more often than there is room for is
// too tangled to tell.
bool leaves(const Mesh& m, const Grid& g, i32 winding_at_infinity, const Vec3& from, const Vec3& to, bool body) {
  const auto is_body = [&](const Vec3& p) { return winding_at(m, g, p, winding_at_infinity) >= 1; };
  Crossings crossings;
  find_crossings(m, g, from, to, crossings);
  if (!crossings.fits || is_body(from) != body) return false;
  for (u32 i = 1; i < crossings.count; ++i) {
    const f64 at = 0.5 * (crossings.at[i - 1] + crossings.at[i]);
    if (crossings.at[i - 1] < crossings.at[i] && is_body(from + at * (to - from)) != body) return true;
  }
  return false;
}

}  // namespace

bool is_pinched(const Mesh& m, const Grid& g, i32 winding_at_infinity, const Regions& r, Span<const CutLoop> loops) {
  if (loops.size != 2) return false;
  const Vec3 centre = midpoint(middle_of_loop(m, r, loops[0]), middle_of_loop(m, r, loops[1]));
  for (const CutLoop& loop : loops) {
    const Vec3 middle = middle_of_loop(m, r, loop);
    const f64 outward = outward_share(m, r, loop, middle);
    if (outward != 0 && leaves(m, g, winding_at_infinity, middle, centre, outward > 0)) return true;
  }
  return false;
}

}  // namespace tpa
