#include "swallowed.h"

namespace tpa {

namespace {

// In Component.family.
enum Verdict : u32 { unknown, stays, goes };

const Vec3& old_position(const Edit& e, u32 v) {
  return e.journal.vertex_stamp[v] == e.journal.stamp ? e.journal.position[v] : e.mesh.position[v];
}

// Only those are judged that have a new vertex or face, or enclosed something before that they do not enclose now. Where
// the local refinement has been taken back a cap has old vertices only.
void choose_changed(const Edit& e, Components& components) {
  const Mesh& m = e.mesh;
  for (Component& part : components.list) {
    part.family = stays;
    part.six_volumes = part.six_volumes_before = 0;
  }
  for (u32 v = 0; v < m.vertex_count; ++v)
    if (vertex_lives(m, v) && !is_old(m, v)) components.list[components.label[v]].family = unknown;
  for (u32 f = 0; f < m.face_count; ++f) {
    if (!face_lives(m, f)) continue;
    const u32* c = m.corner + 3 * f;
    Component& part = components.list[components.label[c[0]]];
    if (m.face_origin[f] == none) part.family = unknown;
    // Seen from one of its vertices: far from the origin little would be left of the digits.
    const Vec3 now = m.position[part.id], before = old_position(e, part.id);
    part.six_volumes += dot(m.position[c[0]] - now, cross(m.position[c[1]] - now, m.position[c[2]] - now));
    part.six_volumes_before += dot(old_position(e, c[0]) - before,
                                   cross(old_position(e, c[1]) - before, old_position(e, c[2]) - before));
  }
  for (Component& part : components.list) {
    const bool turned = (part.six_volumes > 0) != (part.six_volumes_before > 0);
    if (part.family == stays && turned) part.family = unknown;
  }
}

}  // namespace

bool choose_judged(const Edit& e, JudgeWhat what, Span<const Contact> contacts, Components& components) {
  const Mesh& m = e.mesh;
  if (what == JudgeWhat::changed)
    choose_changed(e, components);
  else
    for (Component& part : components.list) part.family = unknown;
  for (const Contact& c : contacts)
    components.list[components.label[m.corner[3 * c.a]]].family =
        components.list[components.label[m.corner[3 * c.b]]].family = stays;
  for (const Component& part : components.list)
    if (part.family == unknown) return true;
  return false;
}

u32 find_swallowed(const Mesh& m, const Grid& g, i32 winding_at_infinity, Components& components) {
  for (u32 v = 0; v < m.vertex_count; ++v) {
    if (!vertex_lives(m, v)) continue;
    u32& verdict = components.list[components.label[v]].family;
    i32 winding = 0;
    if (verdict == unknown && outer_winding(m, g, v, winding_at_infinity, winding)) verdict = winding == 0 ? stays : goes;
  }
  u32 count = 0;
  for (const Component& part : components.list) count += part.family == goes ? 1 : 0;
  return count;
}

u32 remove_swallowed(Edit& e, Grid& g, const Components& components) {
  Mesh& m = e.mesh;
  const auto is_going = [&](u32 v) { return vertex_lives(m, v) && components.list[components.label[v]].family == goes; };
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
