// SPDX-License-Identifier: MIT
#include "step/step_contacts.h"

#include <string.h>

namespace tpa {

namespace {

bool has_moved_to_target(const Workspace& w, u32 v) { return state_of(w, v, target_state) == target_taken; }

// Marks the moved faces. Returns nullptr, with no face marked, where all faces count as moved.
const u8* mark_moved_faces(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  if (!a.is_step() || a.moved == m.vertex_count) return nullptr;
  u8* mark = w.relocation.face_mark;
  const auto moved = [&](u32 v) { return has_moved_to_target(w, v); };
  for (u32 f = 0; f < m.face_count; ++f)
    mark[f] = moved(m.corner[3 * f]) || moved(m.corner[3 * f + 1]) || moved(m.corner[3 * f + 2]) ? 1 : 0;
  return mark;
}

// Arranges all faces in a new face tree.
void detect_anew(Attempt& a) {
  Workspace& w = a.w;
  const u8* active = mark_moved_faces(a);
  detect_complete(w.edit.mesh, w.tree, active, w.relocation.star, a.t.exec, w.detection);
  if (active != nullptr) memset(w.relocation.face_mark, 0, w.edit.mesh.face_count);
  watch(w.near_faces, w.edit.mesh, w.tree);
  a.t.near_faces_stand = true;
}

// Collects the moved faces. False where the near faces cannot take so many, where some left the frame of the face tree,
// or where the tree has no places left nearby.
bool collect_few_moved(Attempt& a) {
  Workspace& w = a.w;
  Relocation& r = w.relocation;
  r.faces.clear();
  if (!a.is_step() || !a.t.near_faces_stand || !a.moves_few() || is_crowded(w.near_faces)) return false;
  for (u32 v : w.targets)
    if (has_moved_to_target(w, v) && is_beyond(w.tree.frame, w.edit.mesh.position[v])) return false;
  for (u32 v : w.targets)
    if (has_moved_to_target(w, v)) for_each_outgoing(w.edit.mesh, v, [&](u32 h) { add_face(r, face_of(h)); });
  return true;
}

}  // namespace

void detect_all(Workspace& w, const Exec& exec) {
  detect_complete(w.edit.mesh, w.tree, nullptr, w.relocation.star, exec, w.detection);
  watch(w.near_faces, w.edit.mesh, w.tree);
  keep_near_faces(w);
  note_peak(w.context, Measure::contacts, w.detection.found);
}

void detect_first(Attempt& a) {
  if (!collect_few_moved(a)) {
    detect_anew(a);
    return;
  }
  Workspace& w = a.w;
  reenter(w.near_faces, w.edit.mesh, w.relocation.faces.span());
  detect_around(w.edit.mesh, w.near_faces, a.t.exec, w.relocation);
}

void detect_again(Attempt& a) {
  Workspace& w = a.w;
  collect_faces(w.edit.mesh, w.work_vertices.span(), w.relocation);
  detect_around(w.edit.mesh, w.near_faces, a.t.exec, w.relocation);
}

bool contacts_fit(Attempt& a) {
  const Detection& d = a.w.detection;
  note_peak(a.w.context, Measure::contacts, d.found);
  if (d.found <= d.pairs.capacity) return true;
  fail_limit(a.t.issue, TPA_LIMIT_CONTACTS, d.found, d.pairs.capacity);
  return false;
}

}  // namespace tpa
