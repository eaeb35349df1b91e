// SPDX-License-Identifier: MIT
#include "step/resolve.h"

#include "cut/pieces.h"
#include "cut/small_contact.h"
#include "cut/snap_cuts.h"
#include "step/step_contacts.h"
#include "surgery/merge_cuts.h"

namespace tpa {

namespace {

// A hub has more faces than this; nearly all vertices have fewer.
constexpr u32 most_faces_of_no_hub = 16;

Vec3 mean_of_loops(const Attempt& a, const Piece& piece) {
  const Clusters& r = a.w.clusters;
  Vec3 sum;
  u32 n = 0;
  for (u32 i = 0; i < piece.loops; ++i) {
    const CutLoop& loop = r.loops[piece.first_loop + i];
    for (u32 k = 0; k < loop.count; ++k, ++n) sum = sum + a.w.edit.mesh.position[r.cuts[loop.first + k].vertex];
  }
  return n == 0 ? sum : 1.0 / n * sum;
}

// Notes handle and caps of a closed piece in report and events.
void record(Attempt& a, const Piece& piece, const PieceOutcome& outcome) {
  const Vec3 where = mean_of_loops(a, piece);
  if (outcome.joined >= 2) {
    ++a.t.report.handles[min_of(outcome.joined, 5u) - 2];
    add_event(a, TPA_EVENT_HANDLE, outcome.joined, TPA_NONE, TPA_NONE, where);
  }
  if (outcome.capped > 0) {
    a.t.report.caps += outcome.capped;
    add_event(a, TPA_EVENT_CAP, outcome.capped, TPA_NONE, TPA_NONE, where);
  }
}

// A hub has many faces, most of them unchanged. Smoothing would draw the hub towards its few new faces.
bool is_hub(const Edit& e, u32 v) {
  const u32 faces = valence(e.mesh, v);
  if (faces <= most_faces_of_no_hub) return false;
  u32 changed = 0;
  for_each_outgoing(e.mesh, v, [&](u32 h) { changed += is_changed(e, face_of(h)) ? 1u : 0u; });
  return 2 * changed < faces;
}

// Collects the vertices to be smoothed in work_vertices: the remaining cut vertices and the ends of cut edges that
// stayed, each once, hubs behind all others. Returns the number of vertices before the hubs.
u32 collect_neighbourhood(Attempt& a) {
  Workspace& w = a.w;
  const Clusters& r = w.clusters;
  w.work_vertices.clear();
  enum : u8 { unknown, is_other, is_a_hub };
  u8* mark = w.relocation.vertex_mark;
  u32 others = 0;
  const auto add = [&](u32 v) {
    if (v == none || mark[v] != unknown) return;
    mark[v] = is_hub(w.edit, v) ? is_a_hub : is_other;
    w.work_vertices.push(v);
    if (mark[v] == is_other) swap_values(w.work_vertices[others++], w.work_vertices[w.work_vertices.size - 1]);
  };
  for (const CutLoop& loop : r.loops)
    for (u32 k = 0; k < loop.count; ++k) {
      add(r.cuts[loop.first + k].vertex);
      add(r.cuts[loop.first + k].outside);
    }
  for (u32 v : w.work_vertices) mark[v] = unknown;
  return others;
}

// Gathers the clusters of the contacts, finds their loops, judges the patches (section 5, figures 6 and 7).
Outcome gather_what_goes(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  forget_clusters(w.clusters);
  gather_clusters(m, w.detection.pairs.span(), w.clusters);
  u64 cuts = 0;
  if (!find_loops(m, w.clusters, cuts)) {
    fail_limit(a.t.issue, TPA_LIMIT_CUT, cuts, w.context.limits.cuts);
    return Outcome::limit;
  }
  note_peak(w.context, Measure::cuts, cuts);
  judge_patches(m, w.near_faces, a.winding_at_infinity(), w.clusters);
  return Outcome::clean;
}

// By the vertex hash, contacts are added until the vertices that go meet nothing else: beyond an unknown seam, a patch
// may bound the region.
Outcome find_what_goes(Attempt& a) {
  Workspace& w = a.w;
  for (;;) {
    if (!follow_seams(a)) return Outcome::limit;
    if (const Outcome o = gather_what_goes(a); o != Outcome::clean || !a.partial) return o;
    collect_faces(w.edit.mesh, w.clusters.members.span(), w.relocation);
    if (listed_meet_no_more(a)) return Outcome::clean;
    forget_clusters(w.clusters);
  }
}

// Finds clusters, loops, patches, groups and pieces. Blocked where the contact is not small.
Outcome find_clusters(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  if (const Outcome o = find_what_goes(a); o != Outcome::clean) return o;
  form_groups(m, w.detection.pairs.span(), w.clusters);
  const bool small = form_pieces(m, w.clusters, w.cluster_area) &&
                     are_small(m, w.clusters, w.cluster_area, w.relocation.vertex_mark, w.work_vertices, a.room);
  return small ? Outcome::clean : Outcome::blocked;
}

// Closes the holes of all pieces (section 5, steps 3 and 5 to 7). A piece left open blocks the paper's way.
Outcome connect_pieces(Attempt& a) {
  Workspace& w = a.w;
  const tpa_config& config = w.context.config;
  const CandidateOptions options{config.max_candidates, {}};
  for (const Piece& piece : w.clusters.pieces) {
    const PieceOutcome outcome =
        connect_piece(w.edit, w.near_faces, w.clusters, piece, options, a.candidates(), w.closing);
    a.trusts = a.trusts || outcome.trusted;
    if (outcome.too_long > 0) {
      fail_limit(a.t.issue, TPA_LIMIT_CUT, cuts_for_piece(outcome.too_long), w.context.limits.cuts);
      return Outcome::limit;
    }
    if (outcome.out_of_faces) {
      fail_limit(a.t.issue, TPA_LIMIT_TRIANGLES, u64{w.context.limits.triangles} + 1, w.context.limits.triangles);
      return Outcome::limit;
    }
    if (!outcome.done) return a.trusts ? Outcome::doubtful : Outcome::blocked;
    record(a, piece, outcome);
  }
  return Outcome::clean;
}

// Vertices or triangles ran out with `more` elements to come.
Outcome out_of_elements(Attempt& a, u64 more) {
  const Mesh& m = a.w.edit.mesh;
  const bool vertices = m.vertex_count == m.vertex_capacity && m.free_vertex == none;
  fail_limit(a.t.issue, vertices ? TPA_LIMIT_VERTICES : TPA_LIMIT_TRIANGLES,
             vertices ? m.vertex_capacity + more : m.face_capacity + more,
             vertices ? m.vertex_capacity : m.face_capacity);
  return Outcome::limit;
}

// Edges left uncut when cut() ran out of elements. Each needs at most one vertex.
u64 undone_cuts(const Clusters& r) {
  u64 undone = 0;
  for (const CutLoop& loop : r.loops)
    for (u32 i = 0; i < loop.count; ++i) {
      const Cut& c = r.cuts[loop.first + i];
      undone += !is_snapped(c) && c.border == none ? 1u : 0u;
    }
  return undone;
}

// Smooths the vertices round the new surfaces. A vertex with snapped cuts starts from the mean of the middles of its
// cut edges, near the vertices of local refinement (figure 6). Returns the number of vertices that kept their new
// places.
u32 smooth_events(Attempt& a, Span<const u32> vertices) {
  Workspace& w = a.w;
  const Span<const Cut> snapped = collect_snapped(w.clusters);
  forget_clusters(w.clusters);
  save(w.edit.mesh, vertices, w.relocation);  // in the memory of the clusters
  // Every vertex moved here is among `vertices`, so settling looks at it.
  for (u32 i = 0; i < snapped.size; ++i)
    if (!is_hub(w.edit, snapped[i].vertex)) set_position(w.edit, snapped[i].vertex, w.clusters.middle[i]);
  const tpa_config& config = w.context.config;
  return smooth(w.edit, w.near_faces, vertices, config.smooth_iterations, {config.smooth_lambda, config.smooth_mu},
                a.t.exec, w.relocation, nullptr);
}

// One pass: clusters, cut, new surfaces, smoothing.
Outcome resolve_contacts(Attempt& a) {
  Workspace& w = a.w;
  if (const Outcome found = find_clusters(a); found != Outcome::clean) return found;
  const Clusters& r = w.clusters;
  a.t.report.groups += r.groups;
  a.t.report.removed_patches += r.removed_patches;
  if (r.removed_patches > 0) add_event(a, TPA_EVENT_REMOVAL, r.removed_patch_vertices, TPA_NONE, TPA_NONE, {});
  snap_cuts(w.edit.mesh, w.clusters, w.relocation.vertex_mark);
  if (!cut(w.edit, w.near_faces, w.clusters)) return out_of_elements(a, undone_cuts(r));
  note_peak(w.context, Measure::vertices, w.edit.mesh.vertex_count);
  if (const Outcome connected = connect_pieces(a); connected != Outcome::clean) return connected;
  note_peak(w.context, Measure::triangles, w.edit.mesh.face_count);
  merge_cuts(w.edit, w.near_faces, w.clusters, w.relocation.vertex_mark, w.relocation.face_mark);
  const u32 others = collect_neighbourhood(a);
  const Span<const u32> around = w.work_vertices.span().part(0, others);
  const u32 kept = smooth_events(a, around);
  // If no vertex went back, smoothing has tested every face that detect_again() would test.
  a.free_around = kept == w.work_vertices.size && w.detection.found == 0;
  return Outcome::clean;
}

}  // namespace

Outcome pass_until_clean(Attempt& a) {
  Workspace& w = a.w;
  for (u32 pass = 0;; ++pass) {
    if (!contacts_fit(a)) return Outcome::limit;
    if (w.detection.pairs.empty()) return Outcome::clean;
    if (pass == w.context.config.max_passes) return Outcome::blocked;
    ++a.t.report.passes;
    if (const Outcome o = resolve_contacts(a); o != Outcome::clean) return o;
    if (a.free_around && !a.partial) continue;
    const bool was_partial = a.partial;
    detect_again(a);
    // A contact of which the hash saw but a part was perhaps not small.
    if (was_partial && !a.partial && w.detection.found > a.t.report.contacts) return Outcome::blocked;
    if (a.trusts && w.detection.found > 0) return Outcome::doubtful;
  }
}

}  // namespace tpa
