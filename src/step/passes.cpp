#include "step/passes.h"

#include <string.h>

#include "cut/keep_exposed.h"
#include "cut/snap_cuts.h"
#include "cut/swallowed_components.h"
#include "edit/bisect.h"
#include "step/fallback.h"
#include "surgery/merge_cuts.h"

namespace tpa {

namespace {

bool has_moved_to_target(const Workspace& w, u32 v) { return state_of(w, v, target_state) == target_taken; }

// Marks the faces that moved; nullptr stands for all, and then none is marked.
const u8* mark_moved_faces(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  if (a.mode == Mode::adapt || a.moved == m.vertex_count) return nullptr;
  u8* mark = w.relocation.face_mark;
  const auto moved = [&](u32 v) { return has_moved_to_target(w, v); };
  for (u32 f = 0; f < m.face_count; ++f)
    mark[f] = moved(m.corner[3 * f]) || moved(m.corner[3 * f + 1]) || moved(m.corner[3 * f + 2]) ? 1 : 0;
  return mark;
}

// Arranges all faces.
void detect_anew(Attempt& a) {
  Workspace& w = a.w;
  const u8* active = mark_moved_faces(a);
  detect_complete(w.edit.mesh, w.tree, active, w.relocation.star, a.exec, w.detection);
  if (active != nullptr) memset(w.relocation.face_mark, 0, w.edit.mesh.face_count);
  watch(w.near_faces, w.edit.mesh, w.tree);
  a.near_faces_stand = true;
}

// The faces that moved, where the near_faces can take them: they are few, and the tree has places where they are.
bool collect_few_moved(Attempt& a) {
  Workspace& w = a.w;
  Relocation& r = w.relocation;
  r.faces.clear();
  if (a.mode == Mode::adapt || !a.near_faces_stand || !a.moves_few() || is_crowded(w.near_faces)) return false;
  for (u32 v : w.targets)
    if (has_moved_to_target(w, v) && is_beyond(w.tree.frame, w.edit.mesh.position[v])) return false;
  for (u32 v : w.targets)
    if (has_moved_to_target(w, v)) for_each_outgoing(w.edit.mesh, v, [&](u32 h) { add_face(r, face_of(h)); });
  return true;
}

void detect_first(Attempt& a) {
  if (!collect_few_moved(a)) {
    detect_anew(a);
    return;
  }
  Workspace& w = a.w;
  reenter(w.near_faces, w.edit.mesh, w.relocation.faces.span());
  detect_around(w.edit.mesh, w.near_faces, a.exec, w.relocation);
}

// Later passes: only the faces round the vertices of the last events are new.
void detect_again(Attempt& a) {
  Workspace& w = a.w;
  collect_faces(w.edit.mesh, w.work_vertices.span(), w.relocation);
  detect_around(w.edit.mesh, w.near_faces, a.exec, w.relocation);
}

// False, with the issue filled in, where there are more contacts than there is room for.
bool contacts_fit(Attempt& a) {
  Workspace& w = a.w;
  note_peak(w.context, Measure::contacts, w.detection.found);
  if (w.detection.found > w.detection.pairs.capacity) {
    fail_limit(a.issue, TPA_LIMIT_CONTACTS, w.detection.found, w.detection.pairs.capacity);
    return false;
  }
  return true;
}

// More faces than nearly all vertices have.
constexpr u32 fewest_of_hub = 16;

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

void record(Attempt& a, const Piece& piece, const PieceOutcome& outcome) {
  const Vec3 where = mean_of_loops(a, piece);
  if (outcome.joined >= 2) {
    ++a.report.handles[min_of(outcome.joined, 5u) - 2];
    add_event(a, TPA_EVENT_HANDLE, outcome.joined, TPA_NONE, TPA_NONE, where);
  }
  if (outcome.capped > 0) {
    a.report.caps += outcome.capped;
    add_event(a, TPA_EVENT_CAP, outcome.capped, TPA_NONE, TPA_NONE, where);
  }
}

// Does the vertex have many faces, most of which are as they were? Smoothing would draw a hub towards the few that are
// not.
bool is_hub(const Edit& e, u32 v) {
  const u32 faces = valence(e.mesh, v);
  if (faces <= fewest_of_hub) return false;
  u32 changed = 0;
  for_each_outgoing(e.mesh, v, [&](u32 h) { changed += is_changed(e, face_of(h)) ? 1 : 0; });
  return 2 * changed < faces;
}

// The cut vertices that are left and the ends of their edges that stayed, each once, into work_vertices: hubs behind
// all others. Returns how many are no hubs.
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

// Loops, groups and pieces of the clusters.
Outcome find_boundary(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  const Span<const Contact> contacts = w.detection.pairs.span();
  u64 cuts = 0;
  if (!find_loops(m, w.clusters, cuts)) {
    fail_limit(a.issue, TPA_LIMIT_CUT, cuts, w.context.limits.cuts);
    return Outcome::limit;
  }
  note_peak(w.context, Measure::cuts, cuts);
  const LeastObject least = a.mode == Mode::step ? LeastObject::inner_face : LeastObject::closed_mesh;
  judge_patches(m, w.near_faces, a.winding_at_infinity(), least, w.clusters);
  form_groups(m, contacts, w.clusters);
  find_pieces(m, w.near_faces, a.winding_at_infinity(), contacts, w.clusters, w.seam);
  return Outcome::clean;
}

Outcome find_clusters(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  const Span<const Contact> contacts = w.detection.pairs.span();
  clear(w.clusters);
  // What is taken along is marked by attempts after the first one of a step only (give_way).
  gather(m, contacts, a.as_in_the_paper() ? nullptr : w.marks, w.clusters);
  if (const Outcome found = find_boundary(a); found != Outcome::clean || a.as_in_the_paper()) return found;
  return keep_visible(m, contacts, w.marks, w.clusters, w.seam) > 0 ? find_boundary(a) : Outcome::clean;
}

Outcome connect_pieces(Attempt& a) {
  Workspace& w = a.w;
  const tpa_config& config = w.context.config;
  const CandidateOptions options{config.max_candidates, {}};
  Outcome result = Outcome::clean;
  const PlanRules rules{a.genus(), a.otherwise(), a.candidates()};
  bool forced = false;
  for (const Piece& piece : w.clusters.pieces) {
    const PieceOutcome outcome = connect_piece(w.edit, w.near_faces, w.clusters, piece, options, rules, w.closing);
    a.trusts = a.trusts || outcome.trusted;
    // Where another piece has given way, so does the attempt, whatever has been trusted since.
    if (a.trusts && !outcome.done && result == Outcome::clean) return Outcome::doubtful;
    if (outcome.too_long > 0 && a.is_last_resort()) {
      fail_limit(a.issue, TPA_LIMIT_CUT, cuts_for_piece(outcome.too_long), w.context.limits.cuts);
      return Outcome::limit;
    }
    if (outcome.out_of_faces) {
      fail_limit(a.issue, TPA_LIMIT_TRIANGLES, u64{w.context.limits.triangles} + 1, w.context.limits.triangles);
      return Outcome::limit;
    }
    forced = forced || outcome.forced;
    if (outcome.done) {
      record(a, piece, outcome);
    } else {
      if (a.is_last_resort()) note_blocked(a, mean_of_loops(a, piece));
      give_way(a, piece, w.closing.open.span());
      result = Outcome::blocked;
    }
  }
  if (forced) ++a.forced_passes;
  return result;
}

Outcome out_of_elements(Attempt& a, u64 more) {
  const Mesh& m = a.w.edit.mesh;
  const bool vertices = m.vertex_count == m.vertex_capacity && m.free_vertex == none;
  fail_limit(a.issue, vertices ? TPA_LIMIT_VERTICES : TPA_LIMIT_TRIANGLES,
             vertices ? m.vertex_capacity + more : m.face_capacity + more,
             vertices ? m.vertex_capacity : m.face_capacity);
  return Outcome::limit;
}

// How many edges have yet to be cut where cut() ran out of elements: each wants one more at most.
u64 undone_cuts(const Clusters& r) {
  u64 undone = 0;
  for (const CutLoop& loop : r.loops)
    for (u32 i = 0; i < loop.count; ++i) {
      const Cut& c = r.cuts[loop.first + i];
      undone += !is_drawn(c) && c.border == none ? 1 : 0;
    }
  return undone;
}

// The faces in contact and those round the new vertices: all contacts there are.
void detect_after_halving(Attempt& a) {
  Workspace& w = a.w;
  Relocation& r = w.relocation;
  r.faces.clear();
  for (const Contact& c : w.detection.pairs) {
    add_face(r, c.a);
    add_face(r, c.b);
  }
  for (u32 v : w.work_vertices) for_each_outgoing(w.edit.mesh, v, [&](u32 h) { add_face(r, face_of(h)); });
  detect_around(w.edit.mesh, w.near_faces, a.exec, r);
}

// Halving a face makes up to two vertices, with its neighbours on the longest-edge path somewhat more; the cuts after
// it become up to twice as many, contacts some eight times, since both faces of a pair may come in two or three. Where
// there is no room for that, the mesh stays as coarse as it is.
bool has_room_to_halve(const Workspace& w, u64 faces) {
  const Mesh& m = w.edit.mesh;
  const u64 most_more = 12 * faces;  // cuts: six for each new vertex
  const u64 cuts = w.clusters.cuts.size + min_of<u64>(w.clusters.cuts.size, most_more), vertices = 2 * faces + cuts;
  return m.vertex_count + vertices <= m.vertex_capacity && m.face_count + 2 * vertices <= m.face_capacity &&
         cuts <= w.clusters.cuts.capacity && u64{8} * w.detection.pairs.size <= w.detection.pairs.capacity;
}

// Components that would vanish are first made finer where they are in contact, until they keep what bounds the region.
Outcome find_clusters_finely(Attempt& a) {
  Workspace& w = a.w;
  for (;;) {
    if (const Outcome found = find_clusters(a); found != Outcome::clean) return found;
    const Span<const Contact> contacts = w.detection.pairs.span();
    find_coarse(w.edit.mesh, contacts, a.care(), w.marks, w.clusters, w.seam, w.relocation.face_mark,
                w.relocation.faces);
    const Span<const u32> faces = w.relocation.faces.span();
    if (faces.empty() || a.halvings == most_halvings || !has_room_to_halve(w, faces.size)) return Outcome::clean;
    ++a.halvings;
    a.halved = true;
    w.work_vertices.clear();
    // What is halved in part is a mesh as good as before.
    if (!halve(w.edit, w.near_faces, faces, w.relocation.face_mark, w.work_vertices)) a.halvings = most_halvings;
    clear(w.clusters);
    detect_after_halving(a);
    if (!contacts_fit(a)) return Outcome::limit;
  }
}

// The vertices that cuts were drawn back to start from where those of the local refinement would be. Returns how many
// vertices did not go back.
u32 smooth_events(Attempt& a, Span<const u32> vertices) {
  Workspace& w = a.w;
  const Span<const Cut> drawn = collect_drawn(w.clusters);
  clear(w.clusters);
  save(w.edit.mesh, vertices, w.relocation);  // where the regions were
  // Whatever moves is among those that are looked at afterwards.
  for (u32 i = 0; i < drawn.size; ++i)
    if (!is_hub(w.edit, drawn[i].vertex)) set_position(w.edit, drawn[i].vertex, w.clusters.middle[i]);
  const tpa_config& config = w.context.config;
  return smooth(w.edit, w.near_faces, vertices, config.smooth_iterations, {config.smooth_lambda, config.smooth_mu},
                a.exec, w.relocation, nullptr);
}

// Clusters, cut, handles, smoothing, for the contacts at hand.
Outcome resolve_contacts(Attempt& a) {
  Workspace& w = a.w;
  if (const Outcome found = find_clusters_finely(a); found != Outcome::clean) return found;
  LostScratch scratch{w.relocation.vertex_mark, w.relocation.vertices};
  const Care care = a.mode == Mode::adapt ? Care::boundary : Care::components;
  const u32 spared = spare_largest(w.edit.mesh, w.detection.pairs.span(), care, w.clusters, w.seam, scratch);
  const Clusters& r = w.clusters;
  a.report.groups += r.groups;
  a.report.removed_patches += r.removed_patches;
  if (r.removed_patches > 0) add_event(a, TPA_EVENT_REMOVAL, r.removed_patch_vertices, TPA_NONE, TPA_NONE, {});
  if (a.as_in_the_paper()) draw_back(w.edit.mesh, w.clusters, w.relocation.vertex_mark);
  if (!cut(w.edit, w.near_faces, w.clusters)) return out_of_elements(a, undone_cuts(r));
  note_peak(w.context, Measure::vertices, w.edit.mesh.vertex_count);
  if (const Outcome connected = connect_pieces(a); connected != Outcome::clean) return connected;
  note_peak(w.context, Measure::triangles, w.edit.mesh.face_count);
  if (a.mode == Mode::step) coarsen(w.edit, w.near_faces, w.clusters, w.relocation.vertex_mark, w.relocation.face_mark);
  const u32 others = collect_neighbourhood(a);
  const Span<const u32> around = w.work_vertices.span().part(0, others);
  // What has been spared may be in contact still, and what is round hubs, where candidates were not tested.
  for (u32 i = 0; i < spared; ++i) w.work_vertices.push(r.members.data[r.members.size + i]);
  const u32 kept = smooth_events(a, around);
  // Where nothing had to go back, settling has looked at all that detect_again() would.
  a.free_around = kept == w.work_vertices.size && w.detection.found == 0;
  return Outcome::clean;
}

// Called before the first event: how the components were.
void note_change(Attempt& a) {
  if (!a.changed) know_components(a.w);
  a.changed = true;
}

// The proofs cost what moved or was changed; where that is much of the mesh, to judge all is as cheap.
bool is_seen_clean(Attempt& a) {
  Workspace& w = a.w;
  if (a.changed)
    return a.parts_known = none_swallowed(w.edit, w.near_faces, a.winding_at_infinity(), w.before, w.parts);
  return a.moves_few() && none_turned(w.edit, w.before);
}

// The result bounds the region of winding number >= 1, also where nothing was in contact: adapt sees to that
// everywhere, a step where it changed something.
void drop_swallowed(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  w.detection.pairs.clear();
  if (!a.changed) know_components(w);
  if (a.mode == Mode::step && is_seen_clean(a)) return;
  if (a.tangled) {
    w.relocation.faces.clear();
    for (u32 f = 0; f < m.face_count; ++f)
      if (face_lives(m, f)) add_face(w.relocation, f);
    detect_around(m, w.near_faces, a.exec, w.relocation);
    if (w.detection.found > w.detection.pairs.capacity) return;  // not known what is in contact
  }
  const JudgeWhat what = a.mode == Mode::adapt ? JudgeWhat::all : a.changed ? JudgeWhat::changed : JudgeWhat::moved;
  Components& parts = a.changed ? w.after : w.before;
  if (a.changed) find_components(m, w.after, w.work_vertices.data);
  if (choose_judged(w.edit, what, w.detection.pairs.span(), parts)) {
    const u32 going = find_swallowed(m, w.near_faces, a.winding_at_infinity(), parts);
    if (going > 0) {
      a.changed = true;
      const u32 vertices = remove_swallowed(w.edit, w.near_faces, parts);
      a.report.removed_patches += going;
      add_event(a, TPA_EVENT_REMOVAL, vertices, TPA_NONE, TPA_NONE, {});
    }
  }
  for (Component& part : w.before.list) {
    part.family = none;
    if (a.changed) part.volume_doubt = unknown_volume;
  }
}

// What is left of the contacts stays (adapt, at last), or has to give way.
Outcome give_up(Attempt& a) {
  if (a.mode == Mode::adapt && a.is_last_resort()) {
    a.tangled = true;
    return Outcome::clean;
  }
  note_blocked(a, a.w.edit.mesh.position[a.w.edit.mesh.corner[3 * a.w.detection.pairs[0].a]]);
  give_way_at_contacts(a);
  return Outcome::blocked;
}

// Resolves the contacts in w.detection and what comes of them.
Outcome pass_until_clean(Attempt& a) {
  Workspace& w = a.w;
  a.halvings = a.forced_passes = 0;
  for (u32 pass = 0;; ++pass) {
    if (!contacts_fit(a)) return Outcome::limit;
    if (w.detection.pairs.empty()) return Outcome::clean;
    if (pass == w.context.config.max_passes || a.forced_passes >= most_forced_passes) return give_up(a);
    ++a.report.passes;
    if (const Outcome o = resolve_contacts(a); o != Outcome::clean) return o;
    if (a.free_around) continue;
    detect_again(a);
    if (a.trusts && w.detection.found > 0) return Outcome::doubtful;
  }
}

// Is v a vertex of a component that waits, as it was? Slots of removed vertices are taken over by new ones.
bool waits(const Workspace& w, u32 v) {
  return v < w.edit.journal.vertex_count && is_old(w.edit.mesh, v) &&
         w.before.list[component_of(w.before, v)].turn == Turn::waits;
}

// Takes the faces of components that wait out of the near_faces, and their contacts out of the list: for now they are
// not there.
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

// Enters the faces of a component and finds their contacts.
void bring_in(Attempt& a, Component& part) {
  Workspace& w = a.w;
  Relocation& r = w.relocation;
  collect_component(w.edit.mesh, part.id, r.vertex_mark, r.vertices);
  r.faces.clear();
  for (u32 v : r.vertices) for_each_outgoing(w.edit.mesh, v, [&](u32 h) { add_face(r, face_of(h)); });
  for (u32 f : r.faces) insert(w.near_faces, w.edit.mesh, f);
  part.turn = Turn::first;
  detect_around(w.edit.mesh, w.near_faces, a.exec, r);
}

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

Outcome resolve_all(Attempt& a) {
  Workspace& w = a.w;
  if (w.detection.pairs.empty()) return Outcome::clean;
  a.report.contacts = w.detection.pairs.size;
  note_change(a);
  const bool waiting =
      !a.as_in_the_paper() && a.winding_at_infinity() == 0 &&
      choose_waiting(w.edit.mesh, w.detection.pairs.span(), w.before, w.relocation.vertex_mark, w.relocation.vertices);
  return waiting ? unite_one_by_one(a) : pass_until_clean(a);
}

}  // namespace

void detect_all(Workspace& w, const Exec& exec) {
  detect_complete(w.edit.mesh, w.tree, nullptr, w.relocation.star, exec, w.detection);
  watch(w.near_faces, w.edit.mesh, w.tree);
  keep_near_faces(w);
  note_peak(w.context, Measure::contacts, w.detection.found);
}

// A mesh without contacts, as steps start from, has none.
void drop_back_to_back(Attempt& a) {
  if (a.w.context.known_clean) return;
  know_components(a.w);
  const u32 count = remove_back_to_back(a.w.edit);
  if (count == 0) return;
  a.changed = true;
  a.report.removed_patches += count;
  add_event(a, TPA_EVENT_REMOVAL, 3 * count, TPA_NONE, TPA_NONE, {});
}

Outcome run_passes(Attempt& a) {
  if (a.is_at_rest()) return Outcome::clean;
  if (a.mode == Mode::adapt) drop_back_to_back(a);
  detect_first(a);
  if (!contacts_fit(a)) return Outcome::limit;
  const Outcome outcome = resolve_all(a);
  if (outcome == Outcome::clean) drop_swallowed(a);
  return outcome;
}

}  // namespace tpa
