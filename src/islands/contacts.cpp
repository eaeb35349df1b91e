// SPDX-License-Identifier: MIT
#include "islands/contacts.h"

#include <string.h>

#include "islands/allowance.h"
#include "mesh/component_changes.h"

namespace tpa {

namespace {

bool has_moved_to_target(const Workspace& w, u32 v) { return state_of(w, v, target_state) == target_taken; }

// ---------------------------------------------------------------- all faces

// Marks the moved faces. Returns nullptr, with no face marked, where all faces count as moved.
const u8* mark_moved_faces(const Transaction& t) {
  const Workspace& w = t.w;
  const Mesh& m = w.edit.mesh;
  if (!t.is_step() || t.moved == m.vertex_count) return nullptr;
  u8* mark = w.relocation.face_mark;
  const auto moved = [&](u32 v) { return has_moved_to_target(w, v); };
  for (u32 f = 0; f < m.face_count; ++f)
    mark[f] = moved(m.corner[3 * f]) || moved(m.corner[3 * f + 1]) || moved(m.corner[3 * f + 2]) ? 1 : 0;
  return mark;
}

// Finds the contacts of active faces, and arranges all faces in a new face tree. Clears the marks.
void detect_anew(Workspace& w, const Exec& exec, const u8* active) {
  detect_complete(w.edit.mesh, w.tree, active, w.relocation.star, w.relocation.rooms, exec, w.detection);
  if (active != nullptr) memset(w.relocation.face_mark, 0, w.edit.mesh.face_count);
  watch(w.near_faces, w.edit.mesh, w.tree);
}

// ---------------------------------------------------------------- few faces

// Enters the moved faces, and lists and marks them. False where complete detection takes less time, where some faces
// left the frame of the face tree, or where the tree has no places left nearby.
bool enter_few_moved(Transaction& t) {
  Workspace& w = t.w;
  Relocation& r = w.relocation;
  clear_faces(r);
  if (!t.is_step() || w.near_faces.tree == nullptr || !t.moves_few() || is_crowded(w.near_faces)) return false;
  for (u32 v : w.targets)
    if (has_moved_to_target(w, v) && is_beyond(w.tree.frame, w.edit.mesh.position[v])) return false;
  for (u32 v : w.targets)
    if (has_moved_to_target(w, v)) add_faces(w.edit.mesh, v, r);
  if (are_many(w.edit.mesh, r.faces.size, r.hub_pairs)) {
    clear_marks(r);
    return false;
  }
  reenter(w.near_faces, w.edit.mesh, r.faces.span());
  return true;
}

}  // namespace

void detect_all(Workspace& w, const Exec& exec) {
  detect_complete(w.edit.mesh, w.tree, nullptr, w.relocation.star, w.relocation.rooms, exec, w.detection);
  watch(w.near_faces, w.edit.mesh, w.tree);
  keep_near_faces(w);
}

void detect_moved_faces(Transaction& t) {
  if (!enter_few_moved(t)) return detect_anew(t.w, t.exec, mark_moved_faces(t));
  detect_around(t.w.edit.mesh, t.w.near_faces, t.exec, t.w.relocation);
}

void detect_listed(Workspace& w, const Exec& exec) {
  const Relocation& r = w.relocation;
  if (are_many(w.edit.mesh, r.faces.size, r.hub_pairs)) return detect_anew(w, exec, r.face_mark);
  detect_around(w.edit.mesh, w.near_faces, exec, w.relocation);
}

void detect_again(Workspace& w, const Exec& exec) {
  collect_faces(w.edit.mesh, w.work_vertices.span(), w.relocation);
  detect_listed(w, exec);
}

void detect_edited(Workspace& w, const Exec& exec) {
  const Edit& e = w.edit;
  const Mesh& m = e.mesh;
  clear_faces(w.relocation);
  for (u32 f : e.journal.faces)
    if (f < m.face_count && face_lives(m, f) && is_changed(e, f)) add_face(w.relocation, f);
  for (u32 v : e.journal.vertices)
    if (v < m.vertex_count && vertex_lives(m, v) && (v >= e.journal.vertex_count || has_moved(e, v)))
      add_faces(m, v, w.relocation);
  detect_listed(w, exec);
}

void roll_back(Workspace& w) {
  NearFaces& near = w.near_faces;
  u64 edits = 0;
  for ([[maybe_unused]] u32 v : w.edit.journal.vertices) ++edits;
  near.meter = nullptr;
  if (near.tree != nullptr && few_of(edits, w.edit.mesh)) {
    rollback(w.edit, near);
  } else {
    rollback(w.edit);
    if (near.tree != nullptr) arrange(w.tree, w.edit.mesh, {});
    if (near.tree != nullptr) watch(near, w.edit.mesh, w.tree);
  }
  keep_near_faces(w);
}

tpa_status fail_tangled(tpa_issue& issue, const Detection& d) {
  issue = {};
  issue.needed = d.found;
  if (!d.pairs.empty() && d.found <= d.pairs.capacity) {
    issue.element = d.pairs[0].a;
    issue.other = d.pairs[0].b;
  }
  return issue.status = TPA_E_TANGLED;
}

Outcome check_contacts(Attempt& a) {
  if (has_stopped(a.meter())) return Outcome::stopped;
  const Detection& d = a.w.detection;
  u64& allowed = a.t.allowance.contacts;
  const Outcome outcome = check_amount(a, TPA_LIMIT_CONTACTS, d.found, allowed, d.pairs.capacity);
  if (allowed == not_known) allowed = contacts_allowed(d.found);
  return outcome;
}

void note_met(Transaction& t) {
  t.met.clear();
  for (const Contact& c : t.w.detection.pairs) for_both(c, [&](u32 f) { t.met.faces.add(f); });
}

void collect_in_contact(Workspace& w) {
  clear_faces(w.relocation);
  for (const Contact& c : w.detection.pairs) {
    add_face(w.relocation, c.a);
    add_face(w.relocation, c.b);
  }
}

}  // namespace tpa
