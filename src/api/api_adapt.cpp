// SPDX-License-Identifier: MIT
// Detection, adaptation, remeshing, smoothing.
#include <string.h>

#include "api/api.h"
#include "results/true_origins.h"
#include "step/advance.h"

namespace tpa {

namespace {

static_assert(sizeof(Contact) == sizeof(tpa_contact) && sizeof(Vec3) == 3 * sizeof(double));

struct Call {
  Context* context;
  Exec exec;
  tpa_report report;
};

// The common start of tpa_step, tpa_advance, tpa_adapt, tpa_remesh and tpa_smooth.
tpa_status start(tpa_context* context, const tpa_exec* exec, i32 exec_position, const tpa_report* report,
                 IssueSlot& slot, Call& call) {
  call.context = slot.context(context);
  if (call.context == nullptr) return slot.issue.status;
  if (!read_exec(exec, exec_position, slot, call.exec)) return slot.issue.status;
  if (report != nullptr && !slot.writable(exec_position + 1, report)) return slot.issue.status;
  if (!call.context->loaded) return slot.fail(TPA_E_STATE);
  call.report = {};
  return TPA_OK;
}

// After a commit: counts into context and report.
void finish(Context& c, Call& call, tpa_report* report) {
  forget_targets(c);
  call.report.vertices = c.vertex_count;
  call.report.triangles = c.face_count;
  if (report != nullptr) write_struct(call.report, report);
}

tpa_status transact(tpa_context* context, Mode mode, const tpa_exec* exec, tpa_report* report, tpa_issue* issue) {
  IssueSlot slot(issue);
  Call call;
  if (const tpa_status s = start(context, exec, 2, report, slot, call); s != TPA_OK) return s;
  Workspace w = open(*call.context);
  if (mode == Mode::step)
    if (const tpa_status s = require_clean(w, call.exec, slot.issue); s != TPA_OK) return s;
  if (const tpa_status s = run_transaction(w, mode, Extent::whole, call.exec, call.report, slot.issue); s != TPA_OK) {
    close(w);
    return s;
  }
  close(w);
  finish(w.context, call, report);
  return TPA_OK;
}

// Does a list of ids, which may be NULL, name vertices of the mesh?
tpa_status check_ids(const u32* ids, u32 count, u32 vertices, IssueSlot& slot) {
  for (u32 i = 0; ids != nullptr && i < count; ++i)
    if (ids[i] >= vertices) return slot.listed({TPA_DEFECT_INDEX_RANGE, i, ids[i]}, vertices);
  return TPA_OK;
}

bool read_options(const tpa_remesh_options* caller, IssueSlot& slot, tpa_remesh_options& o, RemeshOptions& out) {
  const auto refuse = [&](Subject subject, Rule rule) {
    slot.argument(2, subject, rule);
    return false;
  };
  if (!slot.read(2, caller, o)) return false;
  const f64 split = o.split_ratio == 0 ? 4.0 / 3.0 : o.split_ratio;
  const f64 collapse = o.collapse_ratio == 0 ? 0.8 : o.collapse_ratio;
  if (o.iterations < 1 || o.iterations > 100) return refuse(Subject::options_iterations, Rule::sweeps);
  if (o.lengths == nullptr && !(o.target_length > 0 && in_exact_range(o.target_length)))
    return refuse(Subject::options_target_length, Rule::positive_coordinate);
  if (!(split > 0 && split <= 1e6)) return refuse(Subject::options_split_ratio, Rule::split_ratio);
  if (!(collapse > 0 && collapse <= split / 1.5)) return refuse(Subject::options_collapse_ratio, Rule::collapse_ratio);
  if (!(o.relaxation >= 0 && o.relaxation <= 1)) return refuse(Subject::options_relaxation, Rule::fraction);
  if (o.reserved != 0) return refuse(Subject::options_reserved, Rule::zero);
  const f64 target = o.lengths == nullptr ? o.target_length : 1;
  out = {o.iterations, {split * target, collapse * target}, o.relaxation, true};
  return true;
}

// The lists of the options name vertices and lengths of the mesh.
tpa_status check_lists(const tpa_remesh_options& o, u32 vertices, IssueSlot& slot) {
  if (const tpa_status s = check_ids(o.vertices, o.count, vertices, slot); s != TPA_OK) return s;
  for (u32 v = 0; o.lengths != nullptr && v < vertices; ++v)
    if (!(o.lengths[v] > 0 && in_exact_range(f64{o.lengths[v]}))) {
      slot.argument(2, Subject::options_lengths, Rule::positive_coordinate);
      slot.issue.element = v;
      return slot.issue.status;
    }
  return TPA_OK;
}

// Copies the lists to memory that remeshing leaves free. drop_lists() cleans the memory.
u8* take_lists(Workspace& w, const tpa_remesh_options& o, EdgeAims& aims) {
  if (o.lengths != nullptr) {
    aims.length = table_data<f32>(w.context, table_cluster);
    memcpy(aims.length, o.lengths, w.edit.mesh.vertex_count * sizeof(f32));
  }
  if (o.vertices == nullptr) return nullptr;
  for (u32 i = 0; i < o.count; ++i) w.marks[o.vertices[i]] = 1;
  aims.chosen = w.marks;
  return w.marks;
}
void drop_lists(Workspace& w, const EdgeAims& aims) {
  const size_t slots = w.edit.mesh.vertex_count;
  if (aims.length != nullptr) memset(aims.length, 0xFF, slots * sizeof(u32));
  if (aims.chosen != nullptr) memset(w.marks, 0, slots);
}

// Does the context know where a sweep with these lengths would do anything?
bool are_new(const EdgeAims& aims, const Context& c) {
  return aims.length != nullptr || aims.split != c.settled_split || aims.collapse != c.settled_collapse;
}
void note_aims(Context& c, const EdgeAims& aims) {
  c.unsettled_known = true;
  c.settled_split = aims.length == nullptr ? aims.split : 0;  // no length is settled
  c.settled_collapse = aims.collapse;
}

// With a workspace of its own, whose memory on the stack is free again afterwards.
[[gnu::noinline]] tpa_status require_clean_at_first(Call& call, tpa_issue& issue) {
  Workspace w = open(*call.context);
  return require_clean(w, call.exec, issue);
}

// Begins a transaction without topological events. Targets are gone, their memory is free from here on.
void begin_plain(Workspace& w, const Exec& exec) {
  forget_targets(w.context);
  w.relocation.detection = &w.detection;
  w.near_faces.meter = exec.meter;
  begin(w.edit);
  if (w.context.near_faces_stand) {
    resume(w.near_faces, w.edit.mesh, w.tree, w.context.tree);
  } else {
    arrange(w.tree, w.edit.mesh, exec);
    watch(w.near_faces, w.edit.mesh, w.tree);
  }
  w.context.near_faces_stand = false;
  know_components(w);
  keep_volumes(w);
}
void roll_back_plain(Workspace& w) {
  note_elements_in_use(w);
  roll_back(w);
  w.context.components_known = false;
  take_back_components(w);
  close(w);
}
// Commits where the budget has not ended and no contact is left; else nothing is changed. `settled`: lengths that a
// remeshing has brought about, or nullptr.
tpa_status commit_plain(Workspace& w, const EdgeAims* settled, const Exec& exec, tpa_issue& issue) {
  detect_edited(w, exec);
  const bool ends_in_time = end_within_budget(exec.meter);
  if (!ends_in_time || w.detection.found > 0) {
    roll_back_plain(w);
    return ends_in_time ? fail_tangled(issue, w.detection) : fail_stopped(issue, *exec.meter);
  }
  find_true_origins(w);
  for (Component& part : w.before.list) part.before = part.id;
  if (settled != nullptr) note_aims(w.context, *settled);
  publish(w);
  keep_near_faces(w);
  name_components(w.edit.mesh, w.before);
  note_ancestors(w);
  // The components stay the same; their volumes are measured when a step needs them.
  for (Component& part : w.before.list) part.volume.doubt = unknown_volume;
  w.context.components_known = true;
  forget_rolled_back(w.context);
  w.context.event_count = 0;
  return TPA_OK;
}
tpa_status commit_remesh(Workspace& w, const RemeshResult& r, const EdgeAims& aims, const Exec& exec, IssueSlot& slot) {
  if (has_stopped(exec.meter)) {
    roll_back_plain(w);
    return fail_stopped(slot.issue, slot.meter);
  }
  if (r.out_of_vertices || r.out_of_faces) {
    roll_back_plain(w);
    const Limits& l = w.context.limits;
    return fail_limit(slot.issue, r.out_of_vertices ? TPA_LIMIT_VERTICES : TPA_LIMIT_TRIANGLES, r.wanted,
                      r.out_of_vertices ? l.vertices : l.triangles);
  }
  return commit_plain(w, &aims, exec, slot.issue);
}

}  // namespace

}  // namespace tpa

using namespace tpa;

extern "C" {

tpa_status tpa_detect(tpa_context* context, const tpa_exec* exec, tpa_contacts* contacts, tpa_issue* issue) {
  IssueSlot slot(issue);
  Context* c = slot.context(context);
  if (c == nullptr) return slot.issue.status;
  Exec threads;
  if (!read_exec(exec, 2, slot, threads) || !slot.writable(3, contacts)) return slot.issue.status;
  if (!c->loaded) return slot.fail(TPA_E_STATE);
  Workspace w = open(*c);
  if (c->config.detect_mode == TPA_DETECT_VERTEX_HASH) {
    note_longest_edge(*c, w.edit.mesh);
    VertexHash hash = open_vertex_hash(*c);
    hash.meter = threads.meter;
    detect_by_vertices(w.edit.mesh, hash, w.detection);
    if (!end_within_budget(threads.meter)) return fail_stopped(slot.issue, slot.meter);
    note_peak(*c, Measure::contacts, w.detection.found);
  } else if (c->known_clean) {
    w.detection.pairs.clear();
    w.detection.found = 0;
  } else {
    detect_all(w, threads);
    if (!end_within_budget(threads.meter)) return fail_stopped(slot.issue, slot.meter);
    note_peak(*c, Measure::contacts, w.detection.found);
    c->known_clean = w.detection.found == 0;
  }
  if (w.detection.found > w.detection.pairs.capacity)
    return fail_limit(slot.issue, TPA_LIMIT_CONTACTS, w.detection.found, w.detection.pairs.capacity);
  write_struct({0, w.detection.pairs.size, table_data<tpa_contact>(*c, table_contact_pairs)}, contacts);
  return TPA_OK;
}

tpa_status tpa_step(tpa_context* context, const tpa_exec* exec, tpa_report* report, tpa_issue* issue) {
  return transact(context, Mode::step, exec, report, issue);
}

tpa_status tpa_advance(tpa_context* context, double thickness, const tpa_exec* exec, tpa_report* report,
                       tpa_issue* issue) {
  IssueSlot slot(issue);
  Call call;
  if (const tpa_status s = start(context, exec, 3, report, slot, call); s != TPA_OK) return s;
  if (!(thickness >= smallest_magnitude && thickness <= largest_magnitude))
    return slot.argument(2, Subject::thickness, Rule::positive_coordinate);
  if (const tpa_status s = require_clean_at_first(call, slot.issue); s != TPA_OK) return s;
  if (const tpa_status s = run_advance(*call.context, thickness, call.exec, call.report, slot.issue); s != TPA_OK)
    return s;
  finish(*call.context, call, report);
  return TPA_OK;
}

tpa_status tpa_adapt(tpa_context* context, const tpa_exec* exec, tpa_report* report, tpa_issue* issue) {
  return transact(context, Mode::adapt, exec, report, issue);
}

tpa_status tpa_remesh(tpa_context* context, const tpa_remesh_options* options, const tpa_exec* exec, tpa_report* report,
                      tpa_issue* issue) {
  IssueSlot slot(issue);
  tpa_remesh_options given;
  RemeshOptions o;
  if (!read_options(options, slot, given, o)) return slot.issue.status;
  Call call;
  if (const tpa_status s = start(context, exec, 3, report, slot, call); s != TPA_OK) return s;
  if (const tpa_status s = check_lists(given, call.context->vertex_count, slot); s != TPA_OK) return s;
  Workspace w = open(*call.context);
  if (const tpa_status s = require_clean(w, call.exec, slot.issue); s != TPA_OK) return s;
  begin_plain(w, call.exec);
  w.context.components_known = false;
  w.relocation.saved = w.target;  // relaxed vertices may be detected as a whole, in the memory of saved_position
  u8* const chosen = take_lists(w, given, o.aims);
  Unsettled unsettled = open_unsettled(w.context);
  if (!w.context.unsettled_known) unsettle_all(unsettled, w.edit.mesh);
  o.new_aims = w.context.unsettled_known && are_new(o.aims, w.context);
  o.only_part = chosen != nullptr && o.aims.length != nullptr;
  o.part = {given.vertices, given.count};
  const RemeshResult r =
      remesh(w.edit, w.near_faces, w.tree, w.before, unsettled, o, chosen, call.exec, w.relocation, w.work_vertices);
  drop_lists(w, o.aims);
  set_aside(call.exec.meter, 0);
  if (const tpa_status s = commit_remesh(w, r, o.aims, call.exec, slot); s != TPA_OK) {
    take_back(unsettled);
    return s;
  }
  call.report.splits = r.splits;
  call.report.collapses = r.collapses;
  call.report.flips = r.flips;
  call.report.unfinished = r.unfinished;
  call.report.moved = static_cast<u32>(min_of<u64>(r.relaxed, UINT32_MAX));
  close(w);
  finish(w.context, call, report);
  return TPA_OK;
}

tpa_status tpa_smooth(tpa_context* context, const tpa_smooth_options* options, const tpa_exec* exec, tpa_report* report,
                      tpa_issue* issue) {
  IssueSlot slot(issue);
  tpa_smooth_options o;
  if (!slot.read(2, options, o)) return slot.issue.status;
  if (o.iterations > 1000) return slot.argument(2, Subject::options_iterations, Rule::rounds);
  if (o.reserved != 0) return slot.argument(2, Subject::options_reserved, Rule::zero);
  Call call;
  if (const tpa_status s = start(context, exec, 3, report, slot, call); s != TPA_OK) return s;
  const u32 n = call.context->vertex_count;
  if (const tpa_status s = check_ids(o.vertices, o.count, n, slot); s != TPA_OK) return s;
  Workspace w = open(*call.context);
  if (const tpa_status s = require_clean(w, call.exec, slot.issue); s != TPA_OK) return s;
  begin_plain(w, call.exec);
  measure_enclosed(w.edit.mesh, w.before);
  w.work_vertices.clear();
  u8* mark = w.relocation.vertex_mark;
  for (u32 i = 0; i < (o.vertices != nullptr ? o.count : n); ++i) {
    const u32 v = o.vertices != nullptr ? o.vertices[i] : i;
    if (mark[v] == 0) w.work_vertices.push(v);
    mark[v] = 1;
  }
  for (u32 v : w.work_vertices) mark[v] = 0;
  const tpa_config& config = call.context->config;
  w.relocation.wanted = w.target;  // for any number of vertices
  w.relocation.saved = w.edit.journal.position;
  save(w.edit.mesh, w.work_vertices.span(), w.relocation);
  const Span<const u32> listed = w.work_vertices.span();
  const u32 faces = count_faces(w.edit.mesh, listed, w.relocation);
  const u64 of_settling = units_to_detect(w.edit.mesh, faces);
  set_aside(call.exec.meter, 2 * of_settling);
  const u32 rounds = make_rounds(w.edit, listed, faces, o.iterations, {config.smooth_lambda, config.smooth_mu},
                                 call.exec, w.relocation);
  call.report.unfinished = o.iterations - rounds;
  set_aside(call.exec.meter, of_settling);
  call.report.moved = settle_many(w.edit, w.near_faces, w.tree, listed, call.exec, w.relocation, &w.before);
  if (has_stopped(call.exec.meter) && keeps_done(call.exec.meter)) {
    put_all_back(w.edit, w.near_faces, listed, w.relocation);
    call.report.moved = 0;
    call.report.unfinished = o.iterations;
  }
  set_aside(call.exec.meter, 0);
  if (const tpa_status s = commit_plain(w, nullptr, call.exec, slot.issue); s != TPA_OK) return s;
  close(w);
  finish(w.context, call, report);
  return TPA_OK;
}

}  // extern "C"
