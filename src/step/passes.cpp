// SPDX-License-Identifier: MIT
#include "step/passes.h"

#include "cut/swallowed_components.h"
#include "cut/union_order.h"
#include "step/cut_contacts.h"
#include "step/resolve.h"
#include "step/step_contacts.h"

namespace tpa {

namespace {

// Before the first change: labels the present components.
void note_change(Attempt& a) {
  if (!a.changed) know_components(a.w);
  a.changed = true;
}

// Cheap proofs that every component bounds something. Their cost grows with the moved or changed part; from a certain
// share of the mesh on, judging all components costs as much.
bool is_seen_clean(Attempt& a) {
  Workspace& w = a.w;
  if (a.changed)
    return a.parts_known = none_swallowed(w.edit, w.near_faces, a.winding_at_infinity(), w.before, w.parts);
  return a.moves_few() && none_turned(w.edit, w.before);
}

// Removes components that bound no part of the region of winding number >= 1, in contact or not. tpa_adapt removes all
// such components, a step only those made or turned inside out during the step.
void drop_swallowed(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  w.detection.pairs.clear();
  if (!a.changed) know_components(w);
  if (a.is_step() && is_seen_clean(a)) return;
  if (a.tangled) {
    w.relocation.faces.clear();
    for (u32 f = 0; f < m.face_count; ++f)
      if (face_lives(m, f)) add_face(w.relocation, f);
    detect_around(m, w.near_faces, a.t.exec, w.relocation);
    if (w.detection.found > w.detection.pairs.capacity) return;  // components in contact are not known
  }
  const JudgeWhat what = !a.is_step() ? JudgeWhat::all : a.changed ? JudgeWhat::changed : JudgeWhat::moved;
  Components& parts = a.changed ? w.after : w.before;
  if (a.changed) find_components(m, w.after, w.work_vertices.data);
  if (choose_judged(w.edit, what, w.detection.pairs.span(), parts)) {
    const u32 going = find_swallowed(m, w.near_faces, a.winding_at_infinity(), parts);
    if (going > 0) {
      a.changed = true;
      const u32 vertices = remove_swallowed(w.edit, w.near_faces, parts);
      a.t.report.removed_patches += going;
      add_event(a, TPA_EVENT_REMOVAL, vertices, TPA_NONE, TPA_NONE, {});
    }
  }
  if (a.changed)
    for (Component& part : w.before.list) part.volume.doubt = unknown_volume;
}

// Removes components of two triangles back to back, impossible in a mesh free of contacts.
void drop_back_to_back(Attempt& a) {
  if (a.w.context.known_clean) return;
  know_components(a.w);
  const u32 count = remove_back_to_back(a.w.edit);
  if (count == 0) return;
  a.changed = true;
  a.t.report.removed_patches += count;
  add_event(a, TPA_EVENT_REMOVAL, 3 * count, TPA_NONE, TPA_NONE, {});
}

// Is v an old vertex of a component that waits to be united? A new vertex may have taken over the slot of a removed
// vertex.
bool waits(const Workspace& w, u32 v) {
  return v < w.edit.journal.vertex_count && is_old(w.edit.mesh, v) &&
         w.before.list[component_of(w.before, v)].turn == Turn::waits;
}

// Takes the waiting components out of the scene: removes their faces from the near faces, their contacts from the list.
void set_waiting_aside(Workspace& w) {
  const Mesh& m = w.edit.mesh;
  for (u32 f = 0; f < m.face_count; ++f)
    if (waits(w, m.corner[3 * f])) remove(w.near_faces, f);
  u32 kept = 0;
  for (const Contact& c : w.detection.pairs)
    if (!waits(w, m.corner[3 * c.a]) && !waits(w, m.corner[3 * c.b])) w.detection.pairs[kept++] = c;
  w.detection.pairs.size = kept;
  w.detection.found = kept;
}

// Brings a waiting component into the scene: enters its faces and finds their contacts.
void bring_in(Attempt& a, Component& part) {
  Workspace& w = a.w;
  Relocation& r = w.relocation;
  collect_component(w.edit.mesh, part.id, r.vertex_mark, r.vertices);
  r.faces.clear();
  for (u32 v : r.vertices) for_each_outgoing(w.edit.mesh, v, [&](u32 h) { add_face(r, face_of(h)); });
  for (u32 f : r.faces) insert(w.near_faces, w.edit.mesh, f);
  part.turn = Turn::first;
  detect_around(w.edit.mesh, w.near_faces, a.t.exec, r);
}

// Unites components in the order of their ids, so that most pieces have two loops.
Outcome unite_one_by_one(Attempt& a) {
  Workspace& w = a.w;
  set_waiting_aside(w);
  Outcome outcome = pass_until_clean(a);
  for (u32 i = 0; i < w.before.list.size && outcome == Outcome::clean; ++i) {
    if (w.before.list[i].turn != Turn::waits) continue;
    bring_in(a, w.before.list[i]);
    outcome = pass_until_clean(a);
  }
  return outcome;
}

// Resolves the contacts in w.detection.
Outcome resolve_all(Attempt& a) {
  Workspace& w = a.w;
  if (w.detection.pairs.empty()) return Outcome::clean;
  a.t.report.contacts = w.detection.pairs.size;
  note_change(a);
  if (a.rule.strategy == Strategy::cut) return cut_until_clean(a);
  const bool waiting =
      !a.as_in_the_paper() && a.winding_at_infinity() == 0 &&
      choose_waiting(w.edit.mesh, w.detection.pairs.span(), w.before, w.relocation.vertex_mark, w.relocation.vertices);
  return waiting ? unite_one_by_one(a) : pass_until_clean(a);
}

}  // namespace

Outcome run_passes(Attempt& a) {
  if (a.is_at_rest()) return Outcome::clean;
  if (!a.is_step()) drop_back_to_back(a);
  detect_first(a);
  if (!contacts_fit(a)) return Outcome::limit;
  const Outcome outcome = resolve_all(a);
  if (outcome == Outcome::clean) drop_swallowed(a);
  return outcome;
}

}  // namespace tpa
