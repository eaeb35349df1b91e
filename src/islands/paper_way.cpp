// SPDX-License-Identifier: MIT
#include "islands/paper_way.h"

#include "cut/pieces.h"
#include "cut/small_contact.h"
#include "cut/snap_cuts.h"
#include "islands/allowance.h"
#include "islands/close_tunnels.h"
#include "islands/contacts.h"
#include "islands/handles_made.h"
#include "islands/ledger.h"
#include "islands/specks.h"
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

// Notes the handle or cap of a closed piece in report and events.
void record(Attempt& a, const Piece& piece) {
  const bool joined = piece.loops >= 2;
  ++(joined ? a.t.report.handles[min_of(piece.loops, 5u) - 2] : a.t.report.caps);
  add_event(a.t, joined ? TPA_EVENT_HANDLE : TPA_EVENT_CAP, piece.loops, TPA_NONE, TPA_NONE, mean_of_loops(a, piece));
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
Outcome find_what_goes(Attempt& a, u64& cuts) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  forget_clusters(w.clusters);
  gather_clusters(m, w.detection.pairs.span(), w.clusters);
  find_loops(m, w.clusters, cuts);
  const Outcome o = check_amount(a, TPA_LIMIT_CUT, cuts, a.t.allowance.cuts, w.context.limits.cuts);
  if (o != Outcome::clean) return o;
  judge_patches(m, w.near_faces, a.winding_at_infinity(), w.clusters);
  // A patch that goes may reach another island: both are one.
  Claims& claims = w.edit.journal.claims;
  for (u32 v : w.clusters.members) claims.note_owner(claims.vertex_owner[v]);
  if (claims.met != none) return Outcome::blocked;
  return has_stopped(a.meter()) ? Outcome::stopped : Outcome::clean;
}

// Finds clusters, loops, patches, groups and pieces. Blocked where the contact is not small.
Outcome find_clusters(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  u64 cuts = 0;
  if (const Outcome o = find_what_goes(a, cuts); o != Outcome::clean) return o;
  form_groups(m, w.detection.pairs.span(), w.clusters);
  const bool small = form_pieces(m, w.clusters, w.cluster_area) &&
                     are_small(m, w.clusters, w.cluster_area, w.relocation.vertex_mark, w.work_vertices);
  if (!small) return Outcome::blocked;
  if (a.t.allowance.cuts == not_known) a.t.allowance.cuts = cuts_allowed(cuts);
  return Outcome::clean;
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
    if (has_stopped(a.meter())) return Outcome::stopped;
    if (outcome.out_of_faces) return out_of_triangles(a);
    if (!outcome.done) return a.trusts ? Outcome::doubtful : Outcome::blocked;
    record(a, piece);
  }
  return Outcome::clean;
}

// Cuts the loops of all clusters. A cut that is not snapped makes a vertex. Each cut makes a face at most; the surface
// over the holes has at most two faces for each of their vertices.
Outcome cut_loops(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  u32 vertices = 0, cuts = 0;
  for (const CutLoop& loop : w.clusters.loops)
    for (u32 i = 0; i < loop.count; ++i, ++cuts) vertices += is_snapped(w.clusters.cuts[loop.first + i]) ? 0u : 1u;
  note_elements(a, u64{m.vertex_count} + vertices, m.face_count + 3 * u64{cuts});
  if (!has_free_vertices(w.edit, vertices)) return out_of_vertices(a);
  return cut(w.edit, w.near_faces, w.clusters) ? Outcome::clean : out_of_triangles(a);
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

// Blocked where the loops of a piece are too many or too long. A piece may want more room than it has cuts, at most 5/3
// of them.
Outcome check_pieces(Attempt& a) {
  const Clusters& r = a.w.clusters;
  u64 room = 0;
  for (const Piece& piece : r.pieces) {
    if (!can_be_closed(r, piece)) return Outcome::blocked;
    room = max_of(room, room_to_close(r, piece));
  }
  const u64 bound = 2 * min_of<u64>(a.t.allowance.cuts, longest_piece / 2);
  return check_amount(a, TPA_LIMIT_CUT, room, bound, a.w.context.limits.cuts);
}

// One pass: clusters, cut, new surfaces, smoothing.
Outcome resolve_contacts(Attempt& a) {
  Workspace& w = a.w;
  if (const Outcome found = find_clusters(a); found != Outcome::clean) return found;
  const Clusters& r = w.clusters;
  a.t.report.groups += r.groups;
  a.t.report.removed_patches += r.removed_patches;
  if (r.removed_patches > 0) add_event(a.t, TPA_EVENT_REMOVAL, r.removed_patch_vertices, TPA_NONE, TPA_NONE, {});
  if (has_stopped(a.meter())) return Outcome::stopped;
  snap_cuts(w.edit.mesh, w.clusters, w.relocation.vertex_mark);
  if (const Outcome o = check_pieces(a); o != Outcome::clean) return o;
  if (const Outcome o = cut_loops(a); o != Outcome::clean) return o;
  if (const Outcome connected = connect_pieces(a); connected != Outcome::clean) return connected;
  merge_cuts(w.edit, w.near_faces, w.clusters, w.relocation.vertex_mark, w.relocation.face_mark);
  if (has_stopped(a.meter())) return Outcome::stopped;
  const u32 others = collect_neighbourhood(a);
  const Span<const u32> around = w.work_vertices.span().part(0, others);
  const u32 kept = smooth_events(a, around);
  // If no vertex went back, smoothing has tested every face that detect_again() would test.
  a.free_around = kept == w.work_vertices.size && w.detection.found == 0;
  return Outcome::clean;
}

Outcome pass_while_in_contact(Attempt& a) {
  Workspace& w = a.w;
  for (u32 pass = 0;; ++pass) {
    if (const Outcome o = check_contacts(a); o != Outcome::clean) return o;
    if (w.detection.pairs.empty()) return Outcome::clean;
    if (pass == w.context.config.max_passes) return Outcome::blocked;
    ++a.t.report.passes;
    if (const Outcome o = resolve_contacts(a); o != Outcome::clean) return o;
    if (a.free_around) continue;
    detect_again(w, a.t.exec);
    if (a.trusts && w.detection.found > 0) return Outcome::doubtful;
  }
}

}  // namespace

Outcome go_papers_way(Attempt& a) {
  spend(a.meter(), a.w.detection.pairs.size);
  const CutSizes sizes = sizes_of_contacts(a.w);
  const Outcome outcome = pass_while_in_contact(a);
  if (outcome != Outcome::clean || !a.is_step()) return outcome;
  drop_specks(a, sizes);
  a.region = measure_change(a.t, a.ledger.bound);
  if (a.is_overdrawn()) return Outcome::blocked;
  const i64 made = handles_made(a.t);
  if (made < 0 && a.t.lost_handle == LostHandle::stops) return Outcome::loses;
  return close_tunnels(a, sizes, made);
}

}  // namespace tpa
