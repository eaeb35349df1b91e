// SPDX-License-Identifier: MIT
#include "cut/swallowed_components.h"

#include "geometry/ray.h"

namespace tpa {

namespace {

// Chooses the components with a new vertex or face. With local refinement taken back, a cap has old vertices only.
void choose_made(const Edit& e, Components& components) {
  const Mesh& m = e.mesh;
  for (u32 v = 0; v < m.vertex_count; ++v)
    if (vertex_lives(m, v) && !is_old(m, v)) components.list[component_of(components, v)].verdict = Verdict::unknown;
  for (u32 f = 0; f < m.face_count; ++f)
    if (face_lives(m, f) && m.face_origin[f] == none)
      components.list[component_of(components, m.corner[3 * f])].verdict = Verdict::unknown;
}

// Follows the components with a vertex that has moved.
void follow_moved(const Edit& e, Components& components) {
  const Mesh& m = e.mesh;
  for (u32 v : e.journal.vertices)
    if (v < m.vertex_count && vertex_lives(m, v) && has_moved(e, v))
      components.list[component_of(components, v)].is_followed = true;
}

void follow_none(Components& components) {
  for (Component& part : components.list) part.is_followed = false;
}

// Chooses the components that are turned inside out. Within rounding a volume has no sign before a move; without a move
// nothing turns.
void choose_turned(const Edit& e, Components& components) {
  measure_volumes(e, components);
  follow_moved(e, components);
  for (Component& part : components.list) {
    const bool opened = part.is_followed && part.was_flat && part.volume.sum < 0;
    if (opened || (part.volume.sum > 0) != (part.sum_before > 0)) part.verdict = Verdict::unknown;
  }
  follow_none(components);
}

// Follows the components that the transaction has edited or removed.
void follow_edited(const Edit& e, Components& before) {
  for (u32 f : e.journal.faces)
    if (f < e.journal.face_count && is_changed(e, f))
      before.list[component_of(before, old_corners(e, f)[0])].is_followed = true;
}

// Before the transaction, was the vertex of another component inside the followed ones?
bool lay_in_followed(const Edit& e, const Components& before, u32 v) {
  const Vec3 from = old_position(e, v);
  i32 winding = 0;
  for (u32 f = 0; f < e.journal.face_count; ++f) {
    const u32* c = old_corners(e, f);
    if (!before.list[component_of(before, c[0])].is_followed) continue;
    winding += ray_crossing(from, old_position(e, c[0]), old_position(e, c[1]), old_position(e, c[2]));
  }
  return winding > 0;
}

// Does a winding number prove that the outer side of the part is outside?
bool bounds_something(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, const Parts& p, const Part& part) {
  const u32 lists[2] = {part.found.first, part.done.first};
  for (u32 v : lists)
    for (; v != none; v = p.following[v])
      if (i32 winding = 0; outer_winding(m, g, v, winding_at_infinity, winding)) return winding == 0;
  return false;
}

bool any_chosen(const Components& components) {
  for (const Component& part : components.list)
    if (part.verdict <= Verdict::doubted) return true;
  return false;
}

u32 count_going(const Components& components) {
  u32 count = 0;
  for (const Component& part : components.list) count += part.verdict == Verdict::goes ? 1u : 0u;
  return count;
}

// May an untouched component have a negative winding number on its outer side? Only a void may.
bool may_be_left_over(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, const Component& c) {
  i32 winding = 0;
  return !(c.volume.sum > c.volume.doubt) && (!outer_winding(m, g, c.id, winding_at_infinity, winding) || winding < 0);
}

}  // namespace

u32 remove_back_to_back(Edit& e) {
  const Mesh& m = e.mesh;
  u32 count = 0;
  for (u32 f = 0; f < m.face_count; ++f) {
    const u32* opposite = m.opposite + 3 * static_cast<size_t>(f);
    const u32 other = face_of(opposite[0]);
    if (!face_lives(m, f) || face_of(opposite[1]) != other || face_of(opposite[2]) != other) continue;
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) delete_vertex(e, m.corner[h]);
    delete_face(e, f);
    delete_face(e, other);
    ++count;
  }
  return count;
}

bool none_swallowed(const Edit& e, const NearFaces& g, i32 winding_at_infinity, Components& before, Parts& p) {
  const Mesh& m = e.mesh;
  find_parts(e, e.journal.faces, before, p);
  bool all_bound = true;
  for (const Part& part : p.list) spend(g.meter, part.done_count + part.outgoing / 2);
  for (const Part& part : p.list)
    all_bound = all_bound && !has_stopped(g.meter) &&
                (!is_root(p, part) || bounds_something(m, g, winding_at_infinity, p, part));
  spend(g.meter, before.list.size);
  for (const Component& c : before.list)
    all_bound =
        all_bound && !has_stopped(g.meter) && (c.family != none || !may_be_left_over(m, g, winding_at_infinity, c));
  // Components that only moved may have been turned inside out; changed components are among the parts.
  if (all_bound && p.touched.size < before.list.size)
    for (u32 v : e.journal.vertices)
      all_bound = all_bound && (v >= e.journal.vertex_count || before.list[component_of(before, v)].family != none ||
                                !has_moved(e, v));
  if (!all_bound) forget_parts(before, p);
  return all_bound;
}

bool choose_judged(const Edit& e, JudgeWhat what, Components& components) {
  for (Component& part : components.list) part.verdict = what == JudgeWhat::all ? Verdict::unknown : Verdict::stays;
  if (what == JudgeWhat::changed) choose_made(e, components);
  if (what != JudgeWhat::all) choose_turned(e, components);
  return any_chosen(components);
}

bool choose_voids(const Mesh& m, Components& components) {
  for (Component& part : components.list)
    part.verdict = vertex_lives(m, part.id) && part.volume.sum < 0 ? Verdict::doubted : Verdict::stays;
  return any_chosen(components);
}

u32 find_swallowed(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, Components& components) {
  for (u32 v = 0; v < m.vertex_count; ++v) {
    if (!vertex_lives(m, v)) continue;
    Verdict& verdict = components.list[component_of(components, v)].verdict;
    i32 winding = 0;
    if (verdict > Verdict::doubted || has_stopped(g.meter)) continue;
    spend(g.meter, 4);
    if (!outer_winding(m, g, v, winding_at_infinity, winding)) continue;
    verdict = winding == 0 || (verdict == Verdict::doubted && winding > 0) ? Verdict::stays : Verdict::goes;
  }
  return count_going(components);
}

u32 keep_wanted_voids(const Edit& e, Meter* meter, Components& before, Components& components) {
  follow_edited(e, before);
  for (Component& part : components.list) {
    if (part.verdict != Verdict::goes || !is_old(e.mesh, part.id)) continue;
    if (before.list[component_of(before, part.id)].is_followed) continue;
    spend(meter, e.journal.face_count / 4);
    if (has_stopped(meter) || !lay_in_followed(e, before, part.id)) part.verdict = Verdict::stays;
  }
  follow_none(before);
  return count_going(components);
}

u32 remove_swallowed(Edit& e, NearFaces& g, const Components& components) {
  Mesh& m = e.mesh;
  const auto is_going = [&](u32 v) {
    return vertex_lives(m, v) && components.list[component_of(components, v)].verdict == Verdict::goes;
  };
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
