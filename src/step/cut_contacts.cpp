// SPDX-License-Identifier: MIT
#include "step/cut_contacts.h"

#include "arrangement/traces.h"
#include "step/step_contacts.h"
#include "surgery/sew_pieces.h"

namespace tpa {

namespace {

// Lists and marks the faces in contact, and faces without area beside them: these bound nothing, and may meet no other
// face beyond common vertices and edges.
void collect_contact_faces(Workspace& w) {
  Relocation& r = w.relocation;
  const Mesh& m = w.edit.mesh;
  r.faces.clear();
  for (const Contact& c : w.detection.pairs) {
    add_face(r, c.a);
    add_face(r, c.b);
  }
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

// The faces to be tested after a pass: new ones, and those round vertices that have moved.
void enter_changed_faces(Workspace& w) {
  Relocation& r = w.relocation;
  const Mesh& m = w.edit.mesh;
  for (u32 f : r.faces) r.face_mark[f] = 1;
  for (u32 v : w.work_vertices) for_each_outgoing(m, v, [&](u32 h) { add_face(r, face_of(h)); });
  for (u32 f : r.faces) insert(w.near_faces, m, f);
}

Outcome cut_once(Attempt& a) {
  Workspace& w = a.w;
  Relocation& r = w.relocation;
  collect_contact_faces(w);
  Arrangement arrangement = open_arrangement(open_scratch(w.context).arrangement(), w.context.limits.pieces, w.edit.mesh);
  const CutOutcome cut = cut_exactly(arrangement, w.detection.pairs.span(), r.face_mark, w.near_faces,
                                     a.winding_at_infinity());
  note_peak(w.context, Measure::pieces, arrangement.pieces.size);
  if (cut != CutOutcome::success) {
    for (u32 f : r.faces) r.face_mark[f] = 0;
    if (cut == CutOutcome::contradiction) return Outcome::blocked;
    fail_limit(a.t.issue, TPA_LIMIT_PIECES, u64{w.context.limits.pieces} + 1, w.context.limits.pieces);
    return Outcome::limit;
  }
  SewingScratch scratch{r.face_mark, r.faces, r.vertices, w.work_vertices};
  const SewOutcome sewn = sew_pieces(w.edit, w.near_faces, arrangement, scratch);
  if (sewn == SewOutcome::contradiction) return Outcome::blocked;
  if (sewn != SewOutcome::success) return out_of_room(a, sewn);
  note_peak(w.context, Measure::vertices, w.edit.mesh.vertex_count);
  note_peak(w.context, Measure::triangles, w.edit.mesh.face_count);
  part_touching(w.edit, w.work_vertices.span());
  enter_changed_faces(w);
  detect_around(w.edit.mesh, w.near_faces, a.t.exec, r);
  return Outcome::clean;
}

// Rounding of points may make surfaces cross that lie on each other but for rounding. The vertices of their faces move
// apart first: outward, so that parts which touch join, and to a grid much coarser than the rounding, so that what
// crosses then does so clearly (Milenkovic & Sacks 2018; Loriot & Valque 2025, iterative snap rounding).
void separate(Workspace& w, f64 grid) {
  const Mesh& m = w.edit.mesh;
  Relocation& r = w.relocation;
  r.vertices.clear();
  for (u32 f : r.faces)
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
      const u32 v = m.corner[h];
      if (r.vertex_mark[v] != 0) continue;
      r.vertex_mark[v] = 1;
      r.vertices.push(v);
    }
  save(m, r.vertices.span(), r);
  for (u32 v : r.vertices) {
    Vec3 outward;
    for_each_outgoing(m, v, [&](u32 h) {
      const u32 f = face_of(h);
      const Vec3 n = area_normal(r.saved[m.corner[3*f]], r.saved[m.corner[3*f+1]], r.saved[m.corner[3*f+2]]);
      (void)n;
      outward = outward + face_normal(m, f);
    });
    const f64 far = length(outward);
    const Vec3 p = m.position[v] + (far > 0 ? 2 * grid / far : 0) * outward;
    const auto snapped = [&](f64 x) { return grid * static_cast<f64>(floor_to_integer(x / grid + 0.5)); };
    set_position(w.edit, v, into_exact_range({snapped(p.x), snapped(p.y), snapped(p.z)}));
  }
  for (u32 v : r.vertices) r.vertex_mark[v] = 0;
  for (u32 f : r.faces) r.face_mark[f] = 0;
  w.work_vertices.clear();
  for (u32 v : r.vertices) w.work_vertices.push(v);
  collect_faces(m, w.work_vertices.span(), r);
  for (u32 f : r.faces) insert(w.near_faces, m, f);
  detect_around(m, w.near_faces, {}, r);
}

f64 extent_of(const Mesh& m) {
  f64 most = 0;
  for (u32 v = 0; v < m.vertex_count; ++v)
    if (vertex_lives(m, v)) most = max_of(most, max_of(abs_of(m.position[v].x), max_of(abs_of(m.position[v].y), abs_of(m.position[v].z))));
  return most;
}

f64 power_above(f64 x) { f64 p = 0x1p-100; while (p < x) p *= 2; return p; }

}  // namespace

Outcome cut_until_clean(Attempt& a) {
  Workspace& w = a.w;
  for (u32 pass = 0;; ++pass) {
    if (!contacts_fit(a)) return Outcome::limit;
    if (w.detection.pairs.empty()) return Outcome::clean;
    if (pass == w.context.config.max_passes) return Outcome::blocked;
    if (pass > 0) {
      collect_contact_faces(w);
      separate(w, power_above(extent_of(w.edit.mesh)) * 0x1p-44 * static_cast<f64>(u64{1} << 2 * pass));
      if (!contacts_fit(a)) return Outcome::limit;
      if (w.detection.pairs.empty()) return Outcome::clean;
    }
    ++a.t.report.passes;
    if (pass > 0) {
      collect_contact_faces(w);
      separate(w, power_above(extent_of(w.edit.mesh)) * 0x1p-44 * static_cast<f64>(u64{1} << 2 * pass));
      if (!contacts_fit(a)) return Outcome::limit;
      if (w.detection.pairs.empty()) return Outcome::clean;
    }
    ++a.t.report.passes;
    if (const Outcome o = cut_once(a); o != Outcome::clean) return o;
  }
}

}  // namespace tpa
