#include "unfolded.h"

namespace tpa {

namespace {

// A face as it is seen, and what certainly bounds it.
struct Look {
  Seen seen;
  Octagon bounds;
};
// Let u be half an ulp of 1, and r the largest sum of a corner's distances from the origin along the axes. Slopes are 1
// at most, so what is seen is off by 3 u r, and sums and differences of that by 8 u r; their bounds are rounded too.
[[gnu::noinline]] void look_at(const Mesh& m, const Slant& view, u32 f, Look& l) {
  constexpr f64 padding = 8 * 0x1p-53;
  const u32* corner = m.corner + 3 * static_cast<size_t>(f);
  const f64* coordinate = reinterpret_cast<const f64*>(m.position);
  Seen& s = l.seen;
  f64 reach = 0;
  for (u32 i = 0; i < 3; ++i) {
    const f64* at = coordinate + 3 * static_cast<size_t>(corner[i]);
    const f64 x = at[view.axes.x] - view.origin[0], y = at[view.axes.y] - view.origin[1],
              z = at[view.axes.z] - view.origin[2];
    s.x[i] = x - view.by_x * z, s.y[i] = y - view.by_y * z;
    reach = max_of(reach, abs_of(x) + abs_of(y) + abs_of(z));
  }
  const f64 sum[3] = {s.x[0] + s.y[0], s.x[1] + s.y[1], s.x[2] + s.y[2]},
            difference[3] = {s.x[0] - s.y[0], s.x[1] - s.y[1], s.x[2] - s.y[2]};
  const f64 pad = padding * reach;
  bound(s, pad);
  l.bounds = {s.in_x, s.in_y, padded(range_of(sum), 2 * pad), padded(range_of(difference), 2 * pad)};
}
Octagon united(const Octagon& a, const Octagon& b) {
  return {united(a.x, b.x), united(a.y, b.y), united(a.sum, b.sum), united(a.difference, b.difference)};
}
bool are_apart(const Octagon& a, const Octagon& b) {
  return is_apart(a.x, b.x) || is_apart(a.y, b.y) || is_apart(a.sum, b.sum) || is_apart(a.difference, b.difference);
}
// Certainly not on the border either: what is less when it has been rounded was less before.
bool is_within(const Range& r, f64 at) { return (r.low < at) & (at < r.high); }
bool is_within(const Octagon& r, const Point& p) {
  return is_within(r.x, p.x) && is_within(r.y, p.y) && is_within(r.sum, p.x + p.y) &&
         is_within(r.difference, p.x - p.y);
}

// S while it grows.
struct Growth {
  const Mesh& m;
  Unfolded& u;
  Point point;  // on the first face
};

// A face of S, but for the first one; false where it breaks the proof.
[[gnu::noinline]] bool take(Growth& g, u32 f, const Look& l) {
  if (g.u.s.count == g.u.s.capacity || !faces_up(g.u.view.axes, l.seen)) return false;
  if (!is_off(g.u.view.axes, l.seen, g.point)) return false;
  add(g.u.s, f);
  return true;
}

// The faces beside one of S that are not in it yet, where they may reach over R.
bool take_beside(Growth& g, u32 f) {
  for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
    if (g.m.opposite[h] == none) return false;
    const u32 beside = face_of(g.m.opposite[h]);
    if (number_of(g.u.s, beside) != none) continue;
    Look l;
    look_at(g.m, g.u.view, beside, l);
    if (!are_apart(l.bounds, g.u.r) && !take(g, beside, l)) return false;
  }
  return true;
}

// Any view will do: some of the faces tell which one is good.
Slant view_of(const Mesh& m, Span<const u32> some) {
  constexpr u32 enough = 16;
  Vec3 sum;
  for (u32 i = 0; i < some.size; i += 1 + some.size / enough) sum = sum + face_normal(m, some[i]);
  const View v = view_along(sum);
  const Vec3 p = m.position[m.corner[3 * static_cast<size_t>(some[0])]];
  return {v, sum[v.x] / sum[v.z], sum[v.y] / sum[v.z], {p[v.x], p[v.y], p[v.z]}};
}

}  // namespace

bool are_unfolded(const Mesh& m, Span<const u32> some, Unfolded& u) {
  u.view = view_of(m, some);
  Look l;
  look_at(m, u.view, some[0], l);
  if (!faces_up(u.view.axes, l.seen)) return false;
  u.r = l.bounds;
  u.s.count = 0;
  set_places(u.s, Unfolded::places);
  add(u.s, some[0]);
  Growth g{m, u, middle_of(l.seen)};
  for (u32 f : some.part(1, some.size - 1)) {
    look_at(m, u.view, f, l);
    if (!take(g, f, l)) return false;
    u.r = united(u.r, l.bounds);
  }
  if (!is_within(u.r, g.point)) return false;
  for (u32 i = 0; i < u.s.count; ++i)
    if (!take_beside(g, u.face[i])) return false;
  return true;
}

bool is_aside(const Mesh& m, const Unfolded& u, u32 f) {
  Look l;
  look_at(m, u.view, f, l);
  return are_apart(l.bounds, u.r);
}

}  // namespace tpa
