// SPDX-License-Identifier: MIT
#include "step/transaction.h"

#include <string.h>

#include "islands/contacts.h"
#include "islands/islands.h"
#include "mesh/part_volumes.h"
#include "results/component_events.h"
#include "results/region_volume.h"
#include "results/true_origins.h"
#include "step/approach.h"
#include "step/swallowed.h"

namespace tpa {

namespace {

// ---------------------------------------------------------------- move

void move_to_targets(Transaction& t) {
  Workspace& w = t.w;
  spend(t.meter(), w.context.target_count);
  t.report.approach = bound_of_approach(w);
  for (u32 v : w.targets) {
    const bool there = w.target[v] == w.edit.mesh.position[v];
    set_state(w, v, target_state, there ? target_reached : target_taken);
    if (there) continue;
    set_position(w.edit, v, w.target[v]);
    ++t.moved;
  }
}

// Drops all marks but the targets. O(vertices held back and their neighbours).
void forget_marks(Transaction& t) {
  if (t.refused == 0 && !t.blocked) return;
  for (u32 v = 0; v < t.w.context.limits.vertices; ++v) t.w.marks[v] &= target_state;
}

// Puts the mesh back as before.
void take_back(Transaction& t) {
  Workspace& w = t.w;
  note_elements_in_use(w);
  if (t.parts_known) forget_parts(w.before, w.parts);
  forget_clusters(w.clusters);
  forget_islands(t);
  forget_marks(t);
  if (t.changed) w.context.components_known = false;
  roll_back(w);
  take_back_components(w);
}

// ---------------------------------------------------------------- commit

void note_rolled_back(Transaction& t) {
  Workspace& w = t.w;
  const Mesh& m = w.edit.mesh;
  u32 count = 0;  // without vertices removed since; new vertices may have taken over their slots
  for (u32 v : w.targets)
    count += state_of(w, v, target_state) == target_refused && vertex_lives(m, v) && is_old(m, v) ? 1u : 0u;
  t.report.rolled_back_vertices = count;
  if (count > 0) add_event(t, TPA_EVENT_ROLLBACK, count, TPA_NONE, TPA_NONE, t.blocked_at);
}

void publish_rolled_back(Workspace& w, u32 refused) {
  forget_rolled_back(w.context);
  if (refused == 0) return;
  for (u32 v : w.targets)
    if (state_of(w, v, target_state) == target_refused && w.old_to_new[v] != none) {
      w.rolled_back.add(w.old_to_new[v]);
      ++w.context.rolled_back_count;
    }
}

// Events that stay.
u32 events_before(const Transaction& t) { return t.extent == Extent::part ? t.w.context.event_count : 0; }

bool events_fit(Transaction& t) {
  const Stack<tpa_event>& events = t.w.pending_events;
  const bool of_components = t.changed && t.extent == Extent::whole;
  const u64 wanted =
      u64{events_before(t)} + events.size + t.events_lost + (of_components ? count_component_events(t.w.parts) : 0);
  note_peak(t.w.context, Measure::events, wanted);
  if (wanted <= events.capacity) return true;
  fail_limit(t.issue, TPA_LIMIT_EVENTS, wanted, events.capacity);
  return false;
}

bool components_fit(Transaction& t) {
  if (!t.changed) return true;
  const u32 wanted = count_components(t.w.before, t.w.parts), capacity = t.w.before.list.capacity;
  note_peak(t.w.context, Measure::components, wanted);
  if (wanted <= capacity) return true;
  fail_limit(t.issue, TPA_LIMIT_COMPONENTS, wanted, capacity);
  return false;
}

// Publishes mesh and maps, updates the list of components, and adds the events of components.
void publish_components(Transaction& t) {
  Workspace& w = t.w;
  const bool components_known = w.context.components_known;
  if (t.changed) {
    // After a move of most vertices, volumes are measured all at once when needed.
    if (t.moves_few()) measure_parts(w.edit, w.before, w.parts);
    label_parts(w.before, w.parts);
  }
  publish(w);
  publish_rolled_back(w, t.refused);
  w.context.components_known = components_known;
  if (!t.changed) return;
  commit_parts(w.edit, w.before, w.parts);
  note_peak(w.context, Measure::components, w.before.list.size);
  note_ancestors(w);
  if (t.extent == Extent::whole) add_component_events(w);
  forget_parts(w.before, w.parts);
}

// After the commit: the volumes of the whole region.
void report_region(Transaction& t) {
  tpa_report& report = t.report;
  report.region_lost = t.region.lost / 6;
  report.region_gained = t.region.gained / 6;
  report.region_reach = t.region.reach;
  report.region_after = volume_of_region(t.w, t.exec);
  report.region_before = report.region_after + report.region_lost - report.region_gained;
}

// A commit is never interrupted, so its work counts in advance. False if that stops the meter. Behind a sub-step more
// work follows, so what was spent is not enough.
bool end_of_work(Transaction& t) {
  const u64 work = t.units_of_commit();
  set_aside(t.meter(), 0);
  if (t.extent == Extent::whole) return end_within_budget(t.meter(), work);
  spend(t.meter(), work);
  return !has_stopped(t.meter());
}

tpa_status commit_transaction(Transaction& t) {
  Workspace& w = t.w;
  if (t.refused > 0) note_rolled_back(t);
  if (t.changed && !t.parts_known) find_parts(w.edit, w.edit.journal.faces, w.before, w.parts);
  t.parts_known = t.changed;
  if (!components_fit(t) || !events_fit(t)) {
    take_back(t);
    return t.issue.status;
  }
  forget_islands(t);
  forget_marks(t);
  publish_components(t);
  report_region(t);
  publish_events(w, events_before(t));
  w.context.known_clean = t.report.unresolved == 0;
  keep_near_faces(w);
  return TPA_OK;
}

// ---------------------------------------------------------------- the whole

// The contacts of islands without a solution, and of all that rounding brought about (tpa_adapt).
void count_unresolved(Transaction& t) {
  bool any = false;
  for (const Island& island : t.islands) any = any || island.attempt == last_attempt(t.mode);
  if (!any) return;
  set_aside(t.meter(), t.units_of_commit());
  detect_all(t.w, t.exec);
  t.report.unresolved = static_cast<u32>(min_of(t.w.detection.found, u64{UINT32_MAX}));
}

bool contacts_fit(Transaction& t) {
  const Detection& d = t.w.detection;
  note_peak(t.w.context, Measure::contacts, d.found);
  if (d.found <= d.pairs.capacity) return true;
  fail_limit(t.issue, TPA_LIMIT_CONTACTS, d.found, d.pairs.capacity);
  return false;
}

// Moves, detects, settles the islands, and removes what bounds nothing.
Outcome run(Transaction& t) {
  Workspace& w = t.w;
  if (t.is_step()) move_to_targets(t);
  if (t.is_at_rest()) return Outcome::clean;
  if (!t.is_step()) drop_back_to_back(t);
  const u64 before = spent_by(t.meter());
  set_aside(t.meter(), t.units_to_end());
  detect_moved_faces(t);
  if (has_stopped(t.meter())) return Outcome::stopped;
  t.units_of_detection = spent_by(t.meter()) - before;
  if (!contacts_fit(t)) return Outcome::limit;
  t.report.contacts = w.detection.pairs.size;
  if (const Outcome o = settle_islands(t); o != Outcome::clean) return o;
  if (t.changed) find_true_origins(w);
  drop_swallowed(t);
  if (!t.is_step()) count_unresolved(t);
  return has_stopped(t.meter()) ? Outcome::stopped : Outcome::clean;
}

}  // namespace

void publish(Workspace& w) {
  Context& c = w.context;
  note_elements_in_use(w);
  reset_map(w.edit, w.old_to_new, c.old_vertex_count);
  commit(w.edit, w.old_to_new, w.before.label);
  if (w.near_faces.tree != nullptr) renumber(w.near_faces, w.edit.mesh, w.edit.journal.faces);
  note_changes(w.edit, open_changed_vertices(c), open_changed_faces(c));
  forget_volumes(c, w.edit.mesh);
  if (c.unsettled_known) {
    Unsettled unsettled = open_unsettled(c);
    note_changed(unsettled, open_changed_vertices(c), open_changed_faces(c));
  }
  c.all_changed = false;
  c.ancestor_count = 0;
  forget_unmapped(w.edit, w.old_to_new);
  c.old_vertex_count = w.edit.journal.vertex_count;
  c.old_face_count = w.edit.journal.face_count;
  c.components_known = false;
  ++c.epoch;
}

void publish_events(Workspace& w, u32 before) {
  Context& c = w.context;
  memcpy(table_data<tpa_event>(c, table_events) + before, w.pending_events.data,
         w.pending_events.size * sizeof(tpa_event));
  c.event_count = before + w.pending_events.size;
  note_peak(c, Measure::events, c.event_count);
}

namespace {

// The end of a call that keeps what is done, where the budget did not hold enough to keep anything: a commit without a
// change. A step holds back all vertices; tpa_adapt leaves all contacts.
tpa_status commit_nothing(const Transaction& failed) {
  Workspace& w = failed.w;
  tpa_report report{};
  report.contacts = failed.report.contacts;
  report.unresolved = failed.is_step() ? 0 : failed.report.contacts;
  report.unfinished = max_of(1u, failed.islands.size);
  failed.report = report;
  set_aside(failed.meter(), 0);
  w.near_faces.meter = nullptr;
  w.pending_events.clear();
  begin(w.edit);
  Transaction t(w, failed.mode, failed.extent, failed.exec, failed.report, failed.issue);
  for (u32 v : w.targets) {
    if (!t.is_step() || w.target[v] == w.edit.mesh.position[v]) continue;
    set_state(w, v, target_state, target_refused);
    if (t.refused++ == 0) t.blocked_at = w.edit.mesh.position[v];
  }
  return commit_transaction(t);
}

// tpa_adapt tells the contacts that stay, so these have to be known.
bool may_commit_nothing(const Transaction& t, u64 of_end) {
  const Meter* m = t.meter();
  return keeps_done(m) && m->stop == Stop::budget && of_end <= m->budget && (t.is_step() || t.units_of_detection > 0);
}

}  // namespace

tpa_status run_transaction(Workspace& w, Mode mode, Extent extent, const Exec& exec, tpa_report& report,
                           tpa_issue& issue) {
  Context& c = w.context;
  w.relocation.detection = &w.detection;
  w.near_faces.meter = w.clusters.meter = exec.meter;
  w.pending_events.clear();
  Transaction t(w, mode, extent, exec, report, issue);
  if (c.near_faces_stand) resume(w.near_faces, w.edit.mesh, w.tree, c.tree);
  c.near_faces_stand = false;
  keep_volumes(w);
  begin(w.edit);
  allow_slots(w.edit, w.edit.mesh.vertex_capacity, w.edit.mesh.face_capacity);
  const u64 of_end = t.units_to_end() + 8 * u64{w.context.target_count};
  const Outcome outcome = run(t);
  if (outcome == Outcome::clean && end_of_work(t)) return commit_transaction(t);
  take_back(t);
  if (may_commit_nothing(t, of_end)) return commit_nothing(t);
  if (has_stopped(exec.meter)) return fail_stopped(issue, *exec.meter);
  if (outcome == Outcome::limit) return issue.status;
  return fail_tangled(issue, w.detection);
}

}  // namespace tpa
