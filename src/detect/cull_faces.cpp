// SPDX-License-Identifier: MIT
#include "detect/cull_faces.h"

namespace tpa {

namespace {

Octagon united(const Octagon& a, const Octagon& b) {
  return {{min2(a.low[0], b.low[0]), min2(a.low[1], b.low[1])},
          {max2(a.high[0], b.high[0]), max2(a.high[1], b.high[1])}};
}
bool are_apart(const Octagon& a, const Octagon& b) {
  return bits_of_two((a.high[0] < b.low[0]) | (b.high[0] < a.low[0]) | (a.high[1] < b.low[1]) |
                     (b.high[1] < a.low[1])) != 0;
}

// A face in the view, with certain bounds.
struct SlantedFace : Seen {
  Octagon bounds;
};
// Let u be 2^-53, and r the largest sum of a corner's distances from the origin along the three axes. Slopes are at
// most 1, so x and y of a corner in the view are off by less than 4 u r, their sums and differences by less than 10 u
// r. The rounded middle of a face is off by less than 8 u r, and its sum by 18 u r. Bounds padded by 16 u r, and by 32
// u r for sums and differences, hold the true corners and the rounded middle, though the bounds are rounded too.
void view_face(const Mesh& m, const Slant& view, u32 f, SlantedFace& s) {
  constexpr f64 padding = 16 * 0x1p-53;
  const u32* corner = m.corner + 3 * static_cast<size_t>(f);
  const f64* coordinate = reinterpret_cast<const f64*>(m.position);
  const D2 origin = load2(view.origin), by = {view.by_x, view.by_y}, turned = {1, -1};
  Octagon o;
  f64 reach = 0;
  for (u32 i = 0; i < 3; ++i) {
    const f64* at = coordinate + 3 * static_cast<size_t>(corner[i]);
    const D2 xy = D2{at[view.axes.x], at[view.axes.y]} - origin;
    const f64 z = at[view.axes.z] - view.origin[2];
    const D2 p = xy - by * z, q = shuffled<0, 0>(p, p) + shuffled<1, 1>(p, p) * turned;
    s.x[i] = p[0], s.y[i] = p[1];
    o = i == 0 ? Octagon{{p, q}, {p, q}} : united(o, {{p, q}, {p, q}});
    reach = max_of(reach, abs_of(xy[0]) + abs_of(xy[1]) + abs_of(z));
  }
  const f64 pad = padding * reach;
  o = {{o.low[0] - pad, o.low[1] - 2 * pad}, {o.high[0] + pad, o.high[1] + 2 * pad}};
  s.bounds = o;
  s.in_x = {o.low[0][0], o.high[0][0]}, s.in_y = {o.low[0][1], o.high[0][1]};
  s.doubt = doubt_of(s, pad);
}

// Along the mean normal of some sixteen of the faces; any direction is correct.
Slant view_of(const Mesh& m, Span<const u32> some) {
  constexpr u32 enough = 16;
  Vec3 sum;
  for (u32 i = 0; i < some.size; i += 1 + some.size / enough) sum = sum + face_normal(m, some[i]);
  const View v = view_along(sum);
  const Vec3 p = m.position[m.corner[3 * static_cast<size_t>(some[0])]];
  return {v, sum[v.x] / sum[v.z], sum[v.y] / sum[v.z], {p[v.x], p[v.y], p[v.z]}};
}

// A face enters S. False if S is full, or the face breaks (1) or (2).
bool take(Unfolded& u, u32 f, const SlantedFace& s) {
  if (u.count == Unfolded::most || !faces_up(u.view.axes, s) || !is_off(u.view.axes, s, u.once)) return false;
  u.add(f);
  return true;
}

// The neighbours of a face of S enter S if they may reach over R.
bool take_neighbours(const Mesh& m, Unfolded& u, u32 f) {
  for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
    if (m.opposite[h] == none) return false;
    const u32 beside = face_of(m.opposite[h]);
    if (u.has(beside)) continue;
    SlantedFace s;
    view_face(m, u.view, beside, s);
    if (!are_apart(s.bounds, u.r) && !take(u, beside, s)) return false;
  }
  return true;
}

}  // namespace

bool are_unfolded(const Mesh& m, Span<const u32> some, Unfolded& u) {
  u.view = view_of(m, some);
  SlantedFace s;
  view_face(m, u.view, some[0], s);
  if (!faces_up(u.view.axes, s)) return false;
  u.clear();
  u.r = s.bounds;
  u.once = middle_of(s);
  u.add(some[0]);
  for (u32 f : some.part(1, some.size - 1)) {
    view_face(m, u.view, f, s);
    if (!take(u, f, s)) return false;
    u.r = united(u.r, s.bounds);
  }
  for (u32 i = 0; i < u.count; ++i)
    if (!take_neighbours(m, u, u.face[i])) return false;
  return true;
}

bool is_aside(const Mesh& m, const Unfolded& u, u32 f) {
  SlantedFace s;
  view_face(m, u.view, f, s);
  return are_apart(s.bounds, u.r);
}

}  // namespace tpa
