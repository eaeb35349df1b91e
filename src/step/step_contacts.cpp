// SPDX-License-Identifier: MIT
#include "step/step_contacts.h"

#include <string.h>

#include "step/allowance.h"

namespace tpa {

namespace {

bool has_moved_to_target(const Workspace& w, u32 v) { return state_of(w, v, target_state) == target_taken; }

// ---------------------------------------------------------------- all faces

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

// Marks the faces changed by the transaction. Returns nullptr, with no face marked, where all faces count as changed.
const u8* mark_changed_faces(Attempt& a) {
  if (!a.is_step()) return nullptr;
  const Edit& e = a.w.edit;
  u8* mark = a.w.relocation.face_mark;
  for (u32 f : e.journal.faces)
    if (f < e.mesh.face_count && face_lives(e.mesh, f)) mark[f] = 1;
  for (u32 v : e.journal.vertices)
    if (v < e.mesh.vertex_count && vertex_lives(e.mesh, v))
      for_each_outgoing(e.mesh, v, [&](u32 h) { mark[face_of(h)] = 1; });
  return mark;
}

// Finds the contacts of active faces, and arranges all faces in a new face tree. Clears the marks.
void detect_anew(Attempt& a, const u8* active) {
  Workspace& w = a.w;
  detect_complete(w.edit.mesh, w.tree, active, w.relocation.star, w.relocation.rooms, a.t.exec, w.detection);
  if (active != nullptr) memset(w.relocation.face_mark, 0, w.edit.mesh.face_count);
  watch(w.near_faces, w.edit.mesh, w.tree);
  a.t.near_faces_stand = true;
}

// ---------------------------------------------------------------- few faces

// Enters the moved faces, and lists and marks them. False where complete detection takes less time, where some faces
// left the frame of the face tree, or where the tree has no places left nearby.
bool enter_few_moved(Attempt& a) {
  Workspace& w = a.w;
  Relocation& r = w.relocation;
  clear_faces(r);
  if (!a.is_step() || !a.t.near_faces_stand || !a.moves_few() || is_crowded(w.near_faces)) return false;
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

// ---------------------------------------------------------------- vertex hash

// The near faces of the moved mesh, for work on the contacts of the vertex hash.
void enter_moved(Attempt& a) {
  Workspace& w = a.w;
  if (enter_few_moved(a)) return clear_marks(w.relocation);
  arrange(w.tree, w.edit.mesh, a.t.exec);
  watch(w.near_faces, w.edit.mesh, w.tree);
  a.t.near_faces_stand = true;
}

// The contacts that the vertex hash finds in the whole mesh. False if it finds none. O(V).
bool detect_by_hash(Attempt& a) {
  Workspace& w = a.w;
  VertexHash hash = open_vertex_hash(w.context);
  hash.longest_edge = longest_edge(w.edit.mesh);
  hash.meter = a.meter();
  detect_by_vertices(w.edit.mesh, hash, w.detection);
  return w.detection.found > 0;
}

}  // namespace

void detect_all(Workspace& w, const Exec& exec) {
  detect_complete(w.edit.mesh, w.tree, nullptr, w.relocation.star, w.relocation.rooms, exec, w.detection);
  watch(w.near_faces, w.edit.mesh, w.tree);
  keep_near_faces(w);
}

void detect_first(Attempt& a) {
  if (a.t.by_hash && detect_by_hash(a)) {
    a.partial = a.hashed = true;
    return enter_moved(a);
  }
  if (!enter_few_moved(a)) return detect_anew(a, mark_moved_faces(a));
  detect_around(a.w.edit.mesh, a.w.near_faces, a.t.exec, a.w.relocation);
}

void detect_listed(Attempt& a) {
  Workspace& w = a.w;
  const Relocation& r = w.relocation;
  if (!a.partial && are_many(w.edit.mesh, r.faces.size, r.hub_pairs)) return detect_anew(a, r.face_mark);
  if (!a.partial) return detect_around(w.edit.mesh, w.near_faces, a.t.exec, w.relocation);
  clear_marks(w.relocation);
  if (!detect_by_hash(a)) detect_missed(a);
}

void detect_again(Attempt& a) {
  collect_faces(a.w.edit.mesh, a.w.work_vertices.span(), a.w.relocation);
  detect_listed(a);
}

void detect_missed(Attempt& a) {
  a.partial = false;
  detect_anew(a, mark_changed_faces(a));
}

Outcome check_contacts(Attempt& a) {
  if (has_stopped(a.meter())) return Outcome::stopped;
  const Detection& d = a.w.detection;
  u64& allowed = a.t.allowance.contacts;
  if (a.partial) {
    // The vertex hash has seen a part only: all contacts are counted for the issue.
    if (d.found > d.pairs.capacity) detect_missed(a);
    return check_amount(a, TPA_LIMIT_CONTACTS, d.found, not_known, d.pairs.capacity);
  }
  const Outcome outcome = check_amount(a, TPA_LIMIT_CONTACTS, d.found, allowed, d.pairs.capacity);
  if (allowed == not_known) allowed = contacts_allowed(d.found);
  return outcome;
}

void collect_in_contact(Workspace& w) {
  clear_faces(w.relocation);
  for (const Contact& c : w.detection.pairs) {
    add_face(w.relocation, c.a);
    add_face(w.relocation, c.b);
  }
}

Outcome follow_seams(Attempt& a) {
  constexpr u32 most_rounds = 8;
  for (u32 round = 0;; ++round) {
    if (const Outcome o = check_contacts(a); o != Outcome::clean || !a.partial) return o;
    collect_in_contact(a.w);
    if (listed_meet_no_more(a)) return Outcome::clean;
    if (round == most_rounds) detect_missed(a);
  }
}

bool listed_meet_no_more(Attempt& a) {
  Relocation& r = a.w.relocation;
  const u64 known = a.w.detection.found;
  for (u32 f : r.faces) r.face_mark[f] = 1;
  detect_around(a.w.edit.mesh, a.w.near_faces, a.t.exec, r);
  return a.w.detection.found == known;
}

}  // namespace tpa
