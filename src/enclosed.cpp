#include "enclosed.h"

#include "expansion.h"

namespace tpa {

namespace {

f64 size_of(const Vec3& p) { return abs_of(p.x) + abs_of(p.y) + abs_of(p.z); }

// A product of three differences has less than eight roundings for each of its six terms, which add up to the product
// of the sizes at most; the rest is for sums of a few.
constexpr f64 doubt_of_product = 16 * 0x1p-53, doubt_of_sum = 0x1p-52;

Component& part_of(const Components& c, u32 v) { return c.list.data[component_of(c, v)]; }

bool is_sure(f64 six_volumes, f64 doubt) { return abs_of(six_volumes) > doubt; }

void note(Component& part, const SixVolumes& change) {
  part.six_volumes += change.sum;
  part.volume_doubt += change.doubt + doubt_of_sum * abs_of(part.six_volumes);
}

}  // namespace

// Called from many places, which it would make large.
[[gnu::noinline]] void add(SixVolumes& s, f64 sign, const Vec3& from, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = a - from, v = b - from, w = c - from;
  s.sum += sign * dot(u, cross(v, w));
  s.doubt += doubt_of_product * (size_of(u) * size_of(v) * size_of(w)) + doubt_of_sum * abs_of(s.sum);
}

void measure_enclosed(const Mesh& m, Components& c) {
  bool known = true;
  for (const Component& part : c.list)
    known = known && part.volume_doubt < unknown_volume && is_sure(part.six_volumes, part.volume_doubt);
  if (known) return;
  // What the additions lose goes into six_volumes_before meanwhile, and the bounds of what is added into the doubt.
  for (Component& part : c.list) part.six_volumes = part.six_volumes_before = part.volume_doubt = part.size = 0;
  for (u32 f = 0; f < m.face_count; ++f) {
    if (!face_lives(m, f)) continue;
    const u32* corner = m.corner + 3 * f;
    Component& part = part_of(c, corner[0]);
    const Vec3& from = m.position[part.id];
    const Vec3 u = m.position[corner[0]] - from, v = m.position[corner[1]] - from, w = m.position[corner[2]] - from;
    const ExactPair s = two_sum(part.six_volumes, dot(u, cross(v, w)));
    part.six_volumes = s.high;
    part.six_volumes_before += s.low;
    part.volume_doubt += size_of(u) * size_of(v) * size_of(w);
    part.size = max_of(part.size, 2 * size_of(u));
  }
  for (Component& part : c.list) {
    part.six_volumes += part.six_volumes_before;
    part.volume_doubt = 2 * doubt_of_product * part.volume_doubt;
  }
}

bool stays_outside_out(const Components& c, u32 v, const SixVolumes& change) {
  const Component& part = part_of(c, v);
  Component after = part;
  note(after, change);
  return is_sure(part.six_volumes, part.volume_doubt) && is_sure(after.six_volumes, after.volume_doubt) &&
         (part.six_volumes > 0) == (after.six_volumes > 0);
}

void note_change(Components& c, u32 v, const SixVolumes& change) { note(part_of(c, v), change); }

void find_turned(const Mesh& m, const Moves& moves, Components& c, Stack<u32>& turned) {
  const u8* mark = moves.mark;
  const auto for_each_moved = [&](auto visit) {
    for (u32 v : moves.vertices)
      if (mark[v] != 0) visit(v, part_of(c, v));
  };
  const auto old = [&](u32 v) -> const Vec3& { return mark[v] != 0 ? moves.before[v] : m.position[v]; };
  // Each component is seen from where the first of its vertices was, its family meanwhile.
  for_each_moved([&](u32 v, Component& part) {
    if (part.family != none) return;
    part.family = v;
    part.six_volumes_before = part.six_volumes;
  });
  for_each_moved([&](u32 v, Component& part) {
    const Vec3& from = moves.before[part.family];
    for_each_outgoing(m, v, [&](u32 h) {
      const u32 a = head(m, h), b = apex(m, h);
      if ((a < v && mark[a] != 0) || (b < v && mark[b] != 0)) return;
      SixVolumes change;
      add(change, 1, from, m.position[v], m.position[a], m.position[b]);
      add(change, -1, from, old(v), old(a), old(b));
      note(part, change);
    });
  });
  for_each_moved([&](u32 v, Component& part) {
    const bool sure = is_sure(part.six_volumes, part.volume_doubt) && is_sure(part.six_volumes_before, part.volume_doubt);
    if (!sure || (part.six_volumes > 0) != (part.six_volumes_before > 0)) turned.push(v);
  });
  for_each_moved([&](u32, Component& part) {
    if (turned.size > 0 && part.family != none) part.six_volumes = part.six_volumes_before;
    part.family = none;
  });
}

}  // namespace tpa
