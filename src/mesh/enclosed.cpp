#include "mesh/enclosed.h"

#include "geometry/expansion.h"

namespace tpa {

namespace {

// Each of the six terms of a product of three differences has eight roundings at most, and the terms add up to the
// product of the sizes at most. Twice that, since roundings multiply.
constexpr f64 doubt_of_product = 16 * 0x1p-53, doubt_of_sum = 0x1p-52;

Component& part_of(const Components& c, u32 v) { return c.list.data[component_of(c, v)]; }

SixVolumes with(const Component& part, const SixVolumes& change) {
  const f64 sum = part.six_volumes + change.sum;
  return {sum, part.volume_doubt + change.doubt + doubt_of_sum * abs_of(sum)};
}
// Is the sign of both certain, and the same?
bool same_side(const SixVolumes& a, const SixVolumes& b) {
  return abs_of(a.sum) > a.doubt && abs_of(b.sum) > b.doubt && (a.sum > 0) == (b.sum > 0);
}

}  // namespace

void note(Component& part, const SixVolumes& change) {
  const SixVolumes after = with(part, change);
  part.six_volumes = after.sum, part.volume_doubt = after.doubt;
}

void add(SixVolumes& s, f64 sign, const Vec3& from, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = a - from, v = b - from, w = c - from;
  s.sum += sign * dot(u, cross(v, w));
  s.doubt += doubt_of_product * (size_of(u) * size_of(v) * size_of(w)) + doubt_of_sum * abs_of(s.sum);
}

void measure_enclosed(const Mesh& m, Components& c) {
  for (Component& part : c.list) part.six_volumes = part.six_volumes_before = part.volume_doubt = 0;
  for (u32 f = 0; f < m.face_count; ++f) {
    if (!face_lives(m, f)) continue;
    Component& part = part_of(c, m.corner[3 * f]);
    SixVolumes face;
    add(face, 1, m.position[part.id], corner_position(m, 3 * f), corner_position(m, 3 * f + 1),
        corner_position(m, 3 * f + 2));
    // What the addition loses is kept apart.
    const ExactPair s = two_sum(part.six_volumes, face.sum);
    part.six_volumes = s.high;
    part.six_volumes_before += s.low;
    part.volume_doubt += face.doubt;
  }
  // Of what is kept apart, the roundings of n additions are less than (n 2^-53)^2 of all terms.
  const f64 n = m.face_count;
  for (Component& part : c.list) {
    part.six_volumes += part.six_volumes_before;
    part.volume_doubt *= 2 + n * n * 0x1p-57;
  }
}

bool stays_outside_out(const Components& c, u32 v, const SixVolumes& change) {
  const Component& part = part_of(c, v);
  return same_side({part.six_volumes, part.volume_doubt}, with(part, change));
}

void note_change(Components& c, u32 v, const SixVolumes& change) { note(part_of(c, v), change); }

void find_turned(const Mesh& m, const Moves& moves, Components& c, Stack<u32>& turned) {
  const u8* mark = moves.mark;
  for (u32 v : moves.vertices) {
    if (mark[v] == 0) continue;
    Component& part = part_of(c, v);
    if (part.family == none) {  // the first of its vertices
      part.family = 0;
      part.six_volumes_before = part.six_volumes;
    }
    note(part, change_by_move(m, v, moves.before, [&](u32 u) { return mark[u] != 0; }));
  }
  const auto is_turned = [](const Component& part) {
    return !same_side({part.six_volumes_before, part.volume_doubt}, {part.six_volumes, part.volume_doubt});
  };
  bool any = false;
  for (const Component& part : c.list) any = any || (part.family != none && is_turned(part));
  for (u32 v : moves.vertices)
    if (any && mark[v] != 0 && is_turned(part_of(c, v))) turned.push(v);
  for (Component& part : c.list) {
    if (part.family == none) continue;
    if (any) part.six_volumes = part.six_volumes_before;
    part.family = none;
  }
}

}  // namespace tpa
