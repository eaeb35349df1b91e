#include "detect/cull_faces.h"

namespace tpa {

namespace {

Octagon united(const Octagon& a, const Octagon& b) {
  return {{min2(a.low[0], b.low[0]), min2(a.low[1], b.low[1])},
          {max2(a.high[0], b.high[0]), max2(a.high[1], b.high[1])}};
}

// A face as it is seen, and what else certainly bounds it.
struct Look : Seen {
  Octagon in;
};
// Let u be half an ulp of 1, and r the largest sum of a corner's distances from the origin along the axes. Slopes are 1
// at most, so what is seen is off by less than 4 u r, and sums and differences of that by less than 10 u r. The middle
// of a face, rounded, is off by less than 8 u r, and its sum by 18 u r, so it lies inside the bounds; these are rounded
// too.
void look_at(const Mesh& m, const Slant& view, u32 f, Look& l) {
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
    l.x[i] = p[0], l.y[i] = p[1];
    o = i == 0 ? Octagon{{p, q}, {p, q}} : united(o, {{p, q}, {p, q}});
    reach = max_of(reach, abs_of(xy[0]) + abs_of(xy[1]) + abs_of(z));
  }
  const f64 pad = padding * reach;
  o = {{o.low[0] - pad, o.low[1] - 2 * pad}, {o.high[0] + pad, o.high[1] + 2 * pad}};
  l.in = o;
  l.in_x = {o.low[0][0], o.high[0][0]}, l.in_y = {o.low[0][1], o.high[0][1]};
  l.doubt = doubt_of(l, pad);
}
bool are_apart(const Octagon& a, const Octagon& b) {
  return bits_of_two((a.high[0] < b.low[0]) | (b.high[0] < a.low[0]) | (a.high[1] < b.low[1]) |
                     (b.high[1] < a.low[1])) != 0;
}

// S while it grows.
struct Growth {
  const Mesh& m;
  Unfolded& u;
  Point point;  // on the first face
};

// A face of S, but for the first one; false where it breaks the proof.
bool take(Growth& g, u32 f, const Look& l) {
  if (g.u.s.count == g.u.s.capacity || !faces_up(g.u.view.axes, l)) return false;
  if (!is_off(g.u.view.axes, l, g.point)) return false;
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
    if (!are_apart(l.in, g.u.r) && !take(g, beside, l)) return false;
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
  if (!faces_up(u.view.axes, l)) return false;
  u.r = l.in;
  u.s.count = 0;
  set_places(u.s, Unfolded::places);
  add(u.s, some[0]);
  Growth g{m, u, middle_of(l)};
  for (u32 f : some.part(1, some.size - 1)) {
    look_at(m, u.view, f, l);
    if (!take(g, f, l)) return false;
    u.r = united(u.r, l.in);
  }
  for (u32 i = 0; i < u.s.count; ++i)
    if (!take_beside(g, u.face[i])) return false;
  return true;
}

bool is_aside(const Mesh& m, const Unfolded& u, u32 f) {
  Look l;
  look_at(m, u.view, f, l);
  return are_apart(l.in, u.r);
}

}  // namespace tpa
