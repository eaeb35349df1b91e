// SPDX-License-Identifier: MIT
#include "step/cut_contacts.h"

#include "arrangement/traces.h"
#include "step/fallback.h"
#include "step/separate.h"
#include "step/step_contacts.h"
#include "step/tidy_cut.h"
#include "surgery/merge_close.h"
#include "surgery/point_origins.h"
#include "surgery/sew_pieces.h"

namespace tpa {

namespace {

// Lists and marks the faces in contact, and faces without area beside them: these bound nothing, and may meet no other
// face beyond common vertices and edges.
void collect_contact_faces(Workspace& w) {
  Relocation& r = w.relocation;
  const Mesh& m = w.edit.mesh;
  collect_in_contact(w);
  for (u32 i = 0; i < r.faces.size; ++i)
    for (u32 h = 3 * r.faces[i]; h < 3 * r.faces[i] + 3; ++h) {
      const u32 f = face_of(m.opposite[h]);
      if (r.face_mark[f] == 0 && axis_of(m, f) == of_face) add_face(r, f);
    }
}

Outcome out_of_room(Attempt& a, SewOutcome sewn) {
  const Limits& l = a.w.context.limits;
  if (sewn == SewOutcome::vertices)
    fail_limit(a.t.issue, TPA_LIMIT_VERTICES, u64{l.vertices} + 1, l.vertices);
  else
    fail_limit(a.t.issue, TPA_LIMIT_TRIANGLES, u64{l.triangles} + 1, l.triangles);
  return Outcome::limit;
}

Outcome arrange_contacts(Attempt& a, Arrangement& arrangement) {
  Workspace& w = a.w;
  collect_contact_faces(w);
  arrangement = open_arrangement(open_scratch(w.context).arrangement(), w.context.limits.pieces, w.edit.mesh);
  const CutOutcome cut =
      cut_exactly(arrangement, w.detection.pairs.span(), w.relocation.face_mark, w.near_faces, a.winding_at_infinity());
  note_peak(w.context, Measure::pieces, arrangement.pieces.size);
  if (cut == CutOutcome::success) return Outcome::clean;
  clear_marks(w.relocation);
  if (cut == CutOutcome::contradiction) return Outcome::blocked;
  fail_limit(a.t.issue, TPA_LIMIT_PIECES, u64{w.context.limits.pieces} + 1, w.context.limits.pieces);
  return Outcome::limit;
}

// Arranges the faces in contact, and lists the faces that go. By the vertex hash, contacts are added until the faces
// that go meet nothing else: a face beyond an unknown seam may bound the region.
Outcome prepare_cut(Attempt& a, Arrangement& arrangement, SewingScratch& scratch) {
  for (bool known = !a.partial;;) {
    if (!known && !follow_seams(a)) return Outcome::limit;
    if (const Outcome o = arrange_contacts(a, arrangement); o != Outcome::clean) return o;
    if (!find_swallowed_faces(a.w.edit.mesh, arrangement, scratch)) return Outcome::blocked;
    if (known || !a.partial) return Outcome::clean;
    known = listed_meet_no_more(a);  // in the memory of the arrangement
  }
}

// The faces to be tested after a pass: new ones, and those round vertices that have moved.
void enter_changed_faces(Workspace& w) {
  Relocation& r = w.relocation;
  const Mesh& m = w.edit.mesh;
  for (u32 f : r.faces) r.face_mark[f] = 1;
  for (u32 v : w.work_vertices)
    if (vertex_lives(m, v)) for_each_outgoing(m, v, [&](u32 h) { add_face(r, face_of(h)); });
  for (u32 f : r.faces) insert(w.near_faces, m, f);
}

Outcome cut_once(Attempt& a, f64 reach) {
  Workspace& w = a.w;
  Relocation& r = w.relocation;
  Arrangement arrangement;
  SewingScratch scratch{r.face_mark, r.faces, r.vertices, w.work_vertices};
  if (const Outcome o = prepare_cut(a, arrangement, scratch); o != Outcome::clean) return o;
  const SewOutcome sewn = sew_pieces(w.edit, w.near_faces, arrangement, scratch);
  if (sewn != SewOutcome::success) return out_of_room(a, sewn);
  a.t.report.groups += arrangement.groups;
  if (scratch.removed > 0) {
    ++a.t.report.removed_patches;
    add_event(a, TPA_EVENT_REMOVAL, scratch.removed, TPA_NONE, TPA_NONE, {});
  }
  note_peak(w.context, Measure::vertices, w.edit.mesh.vertex_count);
  note_peak(w.context, Measure::triangles, w.edit.mesh.face_count);
  for (u32 f : r.faces) insert(w.near_faces, w.edit.mesh, f);
  merge_close(w.edit, w.near_faces, reach, r.faces, r.face_mark, a.region);
  part_touching(w.edit, w.work_vertices.span(), a.region);
  enter_changed_faces(w);
  detect_listed(a);
  return Outcome::clean;
}

// At first, what lies upon each other but for rounding; afterwards all that rounding has brought into contact.
void choose_separated(Workspace& w, u32 pass) {
  if (pass == 0) return find_nearly_flat(w, separation_of(w.edit.mesh, pass));
  collect_contact_faces(w);
  clear_marks(w.relocation);
}

Outcome cut_passes(Attempt& a) {
  Workspace& w = a.w;
  u32 before = none;
  for (u32 pass = 0; follow_seams(a); ++pass) {
    const u32 contacts = w.detection.pairs.size;
    if (contacts == 0) return Outcome::clean;
    // Where contacts become more, rounding makes them faster than cuts resolve them.
    if (pass == w.context.config.max_passes || (pass > 1 && contacts > before)) return Outcome::blocked;
    before = a.partial ? none : contacts;
    ++a.t.report.passes;
    choose_separated(w, pass);
    const Separation s = separation_of(w.edit.mesh, pass);
    const bool separated = !w.relocation.faces.empty();
    if (separated) {
      separate(a, s);
      if (!contacts_fit(a)) return Outcome::limit;
    }
    if (const Outcome o = cut_once(a, separated ? s.reach : 16 * s.flat); o != Outcome::clean) return o;
  }
  return Outcome::limit;
}

}  // namespace

Outcome cut_until_clean(Attempt& a) {
  const f64 spacing = a.is_step() ? spacing_of_contacts(a.w) : 0;
  const Outcome outcome = cut_passes(a);
  if (outcome == Outcome::clean && spacing > 0) tidy_cut(a, spacing);
  if (outcome == Outcome::clean) forget_false_origins(a.w.edit);
  if (outcome == Outcome::blocked && a.is_step() && !a.hashed) {
    note_blocked(a, a.w.edit.mesh.position[a.w.edit.mesh.corner[3 * a.w.detection.pairs[0].a]]);
    give_way_at_contacts(a);
  }
  return outcome;
}

}  // namespace tpa
