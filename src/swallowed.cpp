#include "swallowed.h"

namespace tpa {

namespace {

// In Component.family.
enum Verdict : u32 { unknown, stays, goes };

const Vec3& old_position(const Edit& e, u32 v) {
  return e.journal.vertex_stamp[v] == e.journal.stamp ? e.journal.position[v] : e.mesh.position[v];
}

// What a face adds to six volumes, seen from a point, and an upper bound of what it adds up to that.
struct FaceVolume {
  f64 six_volumes, terms;
};
FaceVolume volume_of(const Vec3& from, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = a - from, v = b - from, w = c - from;
  const auto size = [](const Vec3& p) { return abs_of(p.x) + abs_of(p.y) + abs_of(p.z); };
  return {dot(u, cross(v, w)), size(u) * size(v) * size(w)};
}

// Of sums over so many faces: each term is off by less than 16 roundings (2^-53) of the bound of its terms, and each
// addition by one of all of them; both once for the sum and once for what it is compared with; and as much again.
f64 doubt_of(f64 terms, u32 faces) { return 0x1p-50 * (static_cast<f64>(faces) + 16) * terms; }

bool has_moved(const Edit& e, u32 v) { return !(old_position(e, v) == e.mesh.position[v]); }

// Only those are judged that have a new vertex, or enclosed something before that they do not enclose now.
void choose_changed(const Edit& e, Components& components) {
  const Mesh& m = e.mesh;
  for (Component& part : components.list) {
    part.family = stays;
    part.six_volumes = part.six_volumes_before = part.volume_doubt = 0;
  }
  for (u32 v = 0; v < m.vertex_count; ++v)
    if (vertex_lives(m, v) && !is_old(m, v)) components.list[component_of(components, v)].family = unknown;
  for (u32 f = 0; f < m.face_count; ++f) {
    if (!face_lives(m, f)) continue;
    const u32* c = m.corner + 3 * f;
    Component& part = components.list[component_of(components, c[0])];
    // Seen from one of its vertices: far from the origin little would be left of the digits.
    const FaceVolume now = volume_of(m.position[part.id], m.position[c[0]], m.position[c[1]], m.position[c[2]]);
    const FaceVolume before = volume_of(old_position(e, part.id), old_position(e, c[0]), old_position(e, c[1]), old_position(e, c[2]));
    part.six_volumes += now.six_volumes;
    part.six_volumes_before += before.six_volumes;
    part.volume_doubt += doubt_of(now.terms, m.face_count);
  }
  for (Component& part : components.list) {
    const bool turned = (part.six_volumes > 0) != (part.six_volumes_before > 0);
    if (part.family == stays && turned) part.family = unknown;
  }
}

}  // namespace

namespace {

// Is its outer side seen to be outside?
bool bounds_something(const Mesh& m, const Grid& g, i32 winding_at_infinity, const Parts& p, const Part& part) {
  const u32 lists[2] = {part.first, part.done};
  for (u32 v : lists)
    for (; v != none; v = p.following[v])
      if (i32 winding = 0; outer_winding(m, g, v, winding_at_infinity, winding)) return winding == 0;
  return false;
}

}  // namespace

bool none_turned(const Edit& e, Components& c) {
  const Mesh& m = e.mesh;
  const Journal& j = e.journal;
  const auto part_of = [&](u32 v) -> Component& { return c.list[component_of(c, v)]; };
  for (u32 v : j.vertices)
    if (has_moved(e, v)) {
      Component& part = part_of(v);
      // The point from which it is seen must stay.
      if (has_moved(e, part.id)) part.volume_doubt = unknown_volume;
      part.six_volumes_before = part.six_volumes;
    }
  for (u32 v : j.vertices) {
    if (!has_moved(e, v)) continue;
    Component& part = part_of(v);
    for_each_outgoing(m, v, [&](u32 h) {
      // Each face is met once, from the smallest of its vertices that moved.
      const u32 a = head(m, h), b = apex(m, h);
      if ((a < v && has_moved(e, a)) || (b < v && has_moved(e, b))) return;
      const Vec3& from = m.position[part.id];
      const FaceVolume now = volume_of(from, m.position[v], m.position[a], m.position[b]);
      const FaceVolume before = volume_of(from, old_position(e, v), old_position(e, a), old_position(e, b));
      part.six_volumes += now.six_volumes - before.six_volumes;
      if (part.volume_doubt == unknown_volume) return;
      // The last two roundings are of the sum.
      part.volume_doubt += doubt_of(now.terms + before.terms, m.face_count) + 0x1p-51 * abs_of(part.six_volumes);
    });
  }
  bool none_did = true;
  for (u32 v : j.vertices)
    if (has_moved(e, v)) {
      const Component& part = part_of(v);
      none_did = none_did && (part.six_volumes > 0) == (part.six_volumes_before > 0) &&
                 abs_of(part.six_volumes) > part.volume_doubt && abs_of(part.six_volumes_before) > part.volume_doubt;
    }
  return none_did;
}

bool none_swallowed(const Edit& e, const Grid& g, i32 winding_at_infinity, Components& before, Parts& p) {
  const Mesh& m = e.mesh;
  find_parts(e, before, p);
  bool all_bound = true;
  for (const Part& part : p.list)
    all_bound = all_bound && (!is_root(p, part) || (part.has_new && bounds_something(m, g, winding_at_infinity, p, part)));
  // What only moved may have been turned inside out.
  for (u32 v : e.journal.vertices)
    all_bound = all_bound && (v >= e.journal.vertex_count || before.list[component_of(before, v)].family != none ||
                              !has_moved(e, v));
  forget_parts(before, p);
  return all_bound;
}

bool choose_judged(const Edit& e, JudgeWhat what, Span<const Contact> contacts, Components& components) {
  const Mesh& m = e.mesh;
  if (what == JudgeWhat::changed)
    choose_changed(e, components);
  else
    for (Component& part : components.list) part.family = unknown;
  for (const Contact& c : contacts)
    components.list[component_of(components, m.corner[3 * c.a])].family =
        components.list[component_of(components, m.corner[3 * c.b])].family = stays;
  for (const Component& part : components.list)
    if (part.family == unknown) return true;
  return false;
}

u32 find_swallowed(const Mesh& m, const Grid& g, i32 winding_at_infinity, Components& components) {
  for (u32 v = 0; v < m.vertex_count; ++v) {
    if (!vertex_lives(m, v)) continue;
    u32& verdict = components.list[component_of(components, v)].family;
    i32 winding = 0;
    if (verdict == unknown && outer_winding(m, g, v, winding_at_infinity, winding)) verdict = winding == 0 ? stays : goes;
  }
  u32 count = 0;
  for (const Component& part : components.list) count += part.family == goes ? 1 : 0;
  return count;
}

u32 remove_swallowed(Edit& e, Grid& g, const Components& components) {
  Mesh& m = e.mesh;
  const auto is_going = [&](u32 v) { return vertex_lives(m, v) && components.list[component_of(components, v)].family == goes; };
  for (u32 v = 0; v < m.vertex_count; ++v) {
    if (!is_going(v)) continue;
    for_each_outgoing(m, v, [&](u32 h) {
      const u32 f = face_of(h);
      if (!face_lives(m, f)) return;
      remove(g, f);
      delete_face(e, f);
    });
  }
  u32 vertices = 0;
  for (u32 v = 0; v < m.vertex_count; ++v) {
    if (!is_going(v)) continue;
    delete_vertex(e, v);
    ++vertices;
  }
  return vertices;
}

}  // namespace tpa
