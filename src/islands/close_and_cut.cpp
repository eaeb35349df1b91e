// SPDX-License-Identifier: MIT
#include "islands/close_and_cut.h"

#include "arrangement/pieces_wanted.h"
#include "arrangement/traces.h"
#include "islands/allowance.h"
#include "islands/close_tunnels.h"
#include "islands/contacts.h"
#include "islands/handles_made.h"
#include "islands/separate.h"
#include "islands/tidy_cut.h"
#include "islands/turned.h"
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

Outcome out_of_elements(Attempt& a, SewOutcome sewn, u64 wanted) {
  const bool vertices = sewn == SewOutcome::vertices;
  const Mesh& m = a.w.edit.mesh;
  note_elements(a, vertices ? wanted : m.vertex_count, vertices ? m.face_count : wanted);
  return vertices ? out_of_vertices(a) : out_of_triangles(a);
}

// Enough for the rest of the call, where an arrangement has no room.
u64 enough_pieces(const Attempt& a, Arrangement& arrangement) {
  const Workspace& w = a.w;
  if (a.t.allowance.pieces != not_known) return a.t.allowance.pieces;
  if (!arrangement.traced) return pieces_for_traces(w.edit.mesh, w.detection.pairs.span(), w.relocation.faces.size);
  return pieces_allowed(arrangement.wanted != 0 ? arrangement.wanted : most_pieces(arrangement, not_known), a.t.mode);
}

// Within limit and allowance.
Outcome arrange_contacts(Attempt& a, Arrangement& arrangement) {
  Workspace& w = a.w;
  collect_contact_faces(w);
  const Span<const Contact> contacts = w.detection.pairs.span();
  const u32 limit = w.context.limits.pieces;
  u64& allowed = a.t.allowance.pieces;
  arrangement = open_arrangement(open_scratch(w.context).arrangement(), static_cast<u32>(min_of<u64>(limit, allowed)),
                                 w.edit.mesh, a.meter());
  const CutOutcome cut =
      cut_exactly(arrangement, contacts, w.relocation.face_mark, w.near_faces, a.winding_at_infinity());
  if (cut != CutOutcome::success) clear_marks(w.relocation);
  if (cut == CutOutcome::stopped) return Outcome::stopped;
  if (cut == CutOutcome::room) return out_of_pieces(a, enough_pieces(a, arrangement));
  const u64 used = pieces_used(arrangement);
  note_peak(w.context, Measure::pieces, used);
  if (allowed == not_known) allowed = pieces_allowed(used, a.t.mode);
  return cut == CutOutcome::success ? Outcome::clean : Outcome::blocked;
}

// The faces to be tested after a pass: new ones, and those round vertices that have moved.
void enter_changed_faces(Workspace& w) {
  Relocation& r = w.relocation;
  const Mesh& m = w.edit.mesh;
  r.hub_pairs = 0;
  for (u32 f : r.faces) r.face_mark[f] = 1;
  const auto add_round = [&](const Stack<u32>& moved) {
    for (u32 v : moved)
      if (vertex_lives(m, v)) add_faces(m, v, r);
  };
  add_round(w.work_vertices);
  add_round(r.vertices);
  for (u32 f : r.faces) insert(w.near_faces, m, f);
}

// Where faces that go belong to another island, its seams bound them as well: both are one.
bool meets_island(Workspace& w, Span<const u32> faces) {
  Claims& claims = w.edit.journal.claims;
  for (u32 f : faces) claims.note_owner(claims.face_owner[f]);
  return claims.met != none;
}

Outcome cut_once(Attempt& a, f64 reach) {
  Workspace& w = a.w;
  Relocation& r = w.relocation;
  Arrangement arrangement;
  SewingScratch scratch{r.face_mark, r.faces, r.vertices, w.work_vertices};
  if (const Outcome o = arrange_contacts(a, arrangement); o != Outcome::clean) return o;
  const bool sound = find_swallowed_faces(w.edit.mesh, arrangement, scratch);
  if (meets_island(w, r.faces.span()) || !sound) {
    clear_marks(r);
    return Outcome::blocked;
  }
  if (has_stopped(a.meter())) return Outcome::stopped;
  const SewOutcome sewn = sew_pieces(w.edit, w.near_faces, arrangement, scratch);
  if (sewn != SewOutcome::success) return out_of_elements(a, sewn, scratch.wanted);
  note_elements(a, w.edit.mesh.vertex_count, w.edit.mesh.face_count);
  a.t.report.groups += arrangement.groups;
  if (scratch.removed > 0) {
    ++a.t.report.removed_patches;
    add_event(a.t, TPA_EVENT_REMOVAL, scratch.removed, TPA_NONE, TPA_NONE, {});
  }
  for (u32 f : r.faces) insert(w.near_faces, w.edit.mesh, f);
  MergeScratch merging{r.face_mark, r.faces, r.vertices};
  merge_close(w.edit, w.near_faces, reach, merging, a.region);
  spend(a.meter(), 8 * u64{w.work_vertices.size});
  part_touching(w.edit, w.work_vertices.span(), a.region);
  enter_changed_faces(w);
  detect_listed(w, a.t.exec);
  return Outcome::clean;
}

// At first, what lies upon each other but for rounding; afterwards all that rounding has brought into contact.
void choose_separated(Workspace& w, const Separation& s, u32 pass) {
  if (pass == 0) return find_nearly_flat(w, s);
  collect_contact_faces(w);
  clear_marks(w.relocation);
}

Outcome cut_passes(Attempt& a) {
  Workspace& w = a.w;
  const Scale scale = scale_of_contacts(w);
  u32 before = none;
  for (u32 pass = 0;; ++pass) {
    if (const Outcome o = check_contacts(a); o != Outcome::clean) return o;
    if (a.is_overdrawn()) return Outcome::blocked;
    const u32 contacts = w.detection.pairs.size;
    if (contacts == 0) return Outcome::clean;
    // Where contacts become more, rounding makes them faster than cuts resolve them.
    if (pass == w.context.config.max_passes || (pass > 1 && contacts > before)) return Outcome::blocked;
    before = contacts;
    ++a.t.report.passes;
    spend(a.meter(), 12 * u64{contacts});
    const Separation s = separation_of(scale, pass);
    choose_separated(w, s, pass);
    const bool separated = !w.relocation.faces.empty();
    if (separated) {
      separate(a, s);
      if (const Outcome o = check_contacts(a); o != Outcome::clean) return o;
    }
    if (const Outcome o = cut_once(a, separated ? s.reach : 16 * s.flat); o != Outcome::clean) return o;
  }
}

}  // namespace

Outcome close_and_cut(Attempt& a) {
  spend(a.meter(), 4 * u64{a.w.detection.pairs.size});
  const CutSizes sizes = a.is_step() ? sizes_of_contacts(a.w) : CutSizes{};
  if (a.is_step()) drop_turned(a);
  Outcome outcome = cut_passes(a);
  if (outcome == Outcome::clean && a.asks() && handles_made(a.t) != 0) return Outcome::loses;
  if (outcome == Outcome::clean && sizes.triangle > 0) {
    tidy_cut(a, sizes);
    outcome = close_tunnels(a, sizes, handles_made(a.t));
  }
  if (outcome != Outcome::clean) return outcome;
  forget_false_origins(a.w.edit);
  return a.is_overdrawn() ? Outcome::blocked : Outcome::clean;
}

}  // namespace tpa
