// SPDX-License-Identifier: MIT
#include "step/passes.h"

#include "cut/swallowed_components.h"
#include "step/cut_contacts.h"
#include "step/resolve.h"
#include "step/step_contacts.h"
#include "step/true_origins.h"

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
  const JudgeWhat what = !a.is_step() ? JudgeWhat::all : a.changed ? JudgeWhat::changed : JudgeWhat::moved;
  spend(a.meter(), a.changed ? 2 * u64{m.face_count} : m.face_count / 2);
  if (has_stopped(a.meter())) return;
  Components& parts = a.changed ? w.after : w.before;
  if (a.changed) find_components(m, w.after, w.work_vertices.data);
  if (choose_judged(w.edit, what, parts)) {
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

// Resolves the contacts in w.detection.
Outcome resolve_all(Attempt& a) {
  Workspace& w = a.w;
  if (w.detection.pairs.empty()) return Outcome::clean;
  a.t.report.contacts = w.detection.pairs.size;
  note_change(a);
  if (a.rule.strategy == Strategy::cut) return cut_until_clean(a);
  return pass_until_clean(a);
}

}  // namespace

Outcome run_passes(Attempt& a) {
  if (a.is_at_rest()) return Outcome::clean;
  if (!a.is_step()) drop_back_to_back(a);
  detect_first(a);
  if (const Outcome o = check_contacts(a); o != Outcome::clean) return o;
  const Outcome outcome = resolve_all(a);
  if (outcome != Outcome::clean) return outcome;
  if (a.changed) find_true_origins(a.w);
  drop_swallowed(a);
  return outcome;
}

}  // namespace tpa
