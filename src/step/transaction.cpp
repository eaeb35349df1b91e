// SPDX-License-Identifier: MIT
#include "step/transaction.h"

#include <string.h>

#include "mesh/part_volumes.h"
#include "step/allowance.h"
#include "step/approach.h"
#include "step/component_events.h"
#include "step/fallback.h"
#include "step/region_check.h"
#include "step/step_contacts.h"

namespace tpa {

namespace {

// ---------------------------------------------------------------- move

void move_to_targets(Attempt& a) {
  if (!a.is_step()) return;
  Workspace& w = a.w;
  spend(a.meter(), w.context.target_count);
  a.t.report.approach = bound_of_approach(w);
  for (u32 v : w.targets) {
    const bool there = w.target[v] == w.edit.mesh.position[v];
    const bool free = state_of(w, v, frozen_state) == free_vertex;
    const u8 state = there ? target_reached : free ? target_taken : target_refused;
    set_state(w, v, target_state, state);
    a.refused += state == target_refused ? 1u : 0u;
    if (state != target_taken) continue;
    set_position(w.edit, v, w.target[v]);
    ++a.moved;
  }
}

// ---------------------------------------------------------------- attempts

void clear_report(tpa_report& report) {
  const u32 size = report.struct_size;
  report = {};
  report.struct_size = size;
}

// Nothing changes. Counts the contacts left by tpa_adapt.
Outcome leave_all(Attempt& a) {
  if (a.is_step()) return Outcome::clean;
  detect_all(a.w, a.t.exec);
  a.t.report.unresolved = static_cast<u32>(min_of(a.w.detection.found, u64{UINT32_MAX}));
  return Outcome::clean;
}

Outcome try_once(Attempt& a) {
  clear_report(a.t.report);
  a.w.pending_events.clear();
  begin(a.w.edit);
  allow_elements(a);
  move_to_targets(a);
  if (a.rule.strategy == Strategy::leave) return leave_all(a);
  const Outcome outcome = run_passes(a);
  if (has_stopped(a.meter())) return Outcome::stopped;
  if (outcome != Outcome::clean || !a.as_in_the_paper() || !a.changed) return outcome;
  RegionChange change;
  if (!is_small_change(a, change)) return Outcome::blocked;
  a.region.add(change);
  return outcome;
}

// Puts the mesh back as before. The face tree can follow after an attempt in the paper's way; an exact cut may
// fail with faces not entered yet.
void take_back(Attempt& a) {
  Workspace& w = a.w;
  note_elements_in_use(w);
  if (a.parts_known) forget_parts(w.before, w.parts);
  forget_clusters(w.clusters);
  a.t.near_faces_stand = a.t.near_faces_stand && a.moves_few() && a.as_in_the_paper();
  if (a.t.near_faces_stand) {
    rollback(w.edit, w.near_faces);
  } else {
    rollback(w.edit);
    w.near_faces.tree = nullptr;
  }
}

// Drops all marks but the targets. O(max_vertices).
void forget_attempts(Workspace& w) {
  for (u32 v = 0; v < w.context.limits.vertices; ++v) w.marks[v] &= target_state;
}

// ---------------------------------------------------------------- commit

void note_rolled_back(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  // A cut may have moved a vertex that stayed, apart from another one at its place.
  for (u32 v : w.targets)
    if (state_of(w, v, target_state) == target_refused && has_moved(w.edit, v))
      set_state(w, v, target_state, target_reached);
  u32 count = 0;  // without vertices removed since; new vertices may have taken over their slots
  for (u32 v : w.targets)
    count += state_of(w, v, target_state) == target_refused && vertex_lives(m, v) && is_old(m, v) ? 1u : 0u;
  a.t.report.rolled_back_vertices = count;
  if (count > 0) add_event(a, TPA_EVENT_ROLLBACK, count, TPA_NONE, TPA_NONE, a.t.blocked_at);
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
u32 events_before(const Attempt& a) { return a.t.extent == Extent::part ? a.w.context.event_count : 0; }

bool events_fit(Attempt& a) {
  const Stack<tpa_event>& events = a.w.pending_events;
  const bool of_components = a.changed && a.t.extent == Extent::whole;
  const u64 wanted =
      u64{events_before(a)} + events.size + a.events_lost + (of_components ? count_component_events(a.w.parts) : 0);
  note_peak(a.w.context, Measure::events, wanted);
  if (wanted <= events.capacity) return true;
  fail_limit(a.t.issue, TPA_LIMIT_EVENTS, wanted, events.capacity);
  return false;
}

bool components_fit(Attempt& a) {
  if (!a.changed) return true;
  const u32 wanted = count_components(a.w.before, a.w.parts), capacity = a.w.before.list.capacity;
  note_peak(a.w.context, Measure::components, wanted);
  if (wanted <= capacity) return true;
  fail_limit(a.t.issue, TPA_LIMIT_COMPONENTS, wanted, capacity);
  return false;
}

// Publishes mesh and maps, updates the list of components, and adds the events of components.
void publish_components(Attempt& a) {
  Workspace& w = a.w;
  const bool components_known = w.context.components_known;
  if (a.changed) {
    // After a move of most vertices, volumes are measured all at once when needed.
    if (a.moves_few()) measure_parts(w.edit, w.before, w.parts);
    label_parts(w.before, w.parts);
  }
  publish(w);
  publish_rolled_back(w, a.refused);
  w.context.components_known = components_known;
  if (!a.changed) return;
  commit_parts(w.edit, w.before, w.parts);
  note_peak(w.context, Measure::components, w.before.list.size);
  note_ancestors(w);
  if (a.t.extent == Extent::whole) add_component_events(w);
  forget_parts(w.before, w.parts);
}

// The region's volumes; of the whole region only where that costs no more than the rest of the call.
void report_region(Attempt& a) {
  tpa_report& report = a.t.report;
  report.region_lost = a.region.lost / 6;
  report.region_gained = a.region.gained / 6;
  report.region_reach = a.region.reach;
  a.w.region_measured = !a.is_step() || !a.moves_few();
  if (!a.w.region_measured) return;
  if (a.six_volumes_of_bodies < 0) a.six_volumes_of_bodies = six_volumes(a.w.edit.mesh, a.t.exec);
  const f64 volume = a.six_volumes_of_bodies / 6;
  report.region_after = volume;
  report.region_before = volume + report.region_lost - report.region_gained;
}

// A commit is never interrupted, so its work counts in advance. False if that stops the meter. Behind a sub-step more
// work follows, so what was spent is not enough.
bool end_of_work(Attempt& a) {
  const Mesh& m = a.w.edit.mesh;
  const u64 of_moves = 1 + (a.moves_few() ? 8 * u64{a.moved} : m.vertex_count);
  const u64 work = of_moves + (a.changed && !a.parts_known ? m.face_count : 0);
  if (a.t.extent == Extent::whole) return end_within_budget(a.meter(), work);
  spend(a.meter(), work);
  return !has_stopped(a.meter());
}

tpa_status commit_attempt(Attempt& a) {
  Workspace& w = a.w;
  if (!a.is_first()) forget_attempts(w);
  if (a.refused > 0) note_rolled_back(a);
  if (a.changed && !a.parts_known) find_parts(w.edit, w.before, w.parts);
  if (!components_fit(a) || !events_fit(a)) {
    if (a.changed) forget_parts(w.before, w.parts);
    w.context.components_known = false;
    rollback(w.edit);
    return a.t.issue.status;
  }
  report_region(a);
  publish_components(a);
  publish_events(w, events_before(a));
  w.context.known_clean = a.t.report.unresolved == 0;
  if (a.t.near_faces_stand) keep_near_faces(w);
  return TPA_OK;
}

}  // namespace

void publish(Workspace& w) {
  Context& c = w.context;
  note_elements_in_use(w);
  reset_map(w.edit, w.old_to_new, c.old_vertex_count);
  commit(w.edit, w.old_to_new, w.before.label);
  if (w.near_faces.tree != nullptr) renumber(w.near_faces, w.edit.mesh, w.edit.journal.faces);
  note_changes(w.edit, open_changed_vertices(c), open_changed_faces(c));
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

tpa_status run_transaction(Workspace& w, Mode mode, Extent extent, const Exec& exec, tpa_report& report,
                           tpa_issue& issue) {
  w.relocation.detection = &w.detection;
  w.near_faces.meter = w.clusters.meter = exec.meter;
  Transaction t{w, mode, extent, exec, report, issue};
  t.by_hash = w.context.config.detect_mode == TPA_DETECT_VERTEX_HASH;
  t.near_faces_stand = w.context.near_faces_stand;
  if (t.near_faces_stand) resume(w.near_faces, w.edit.mesh, w.tree, w.context.tree);
  w.context.near_faces_stand = false;
  for (u32 number = 0;;) {
    Attempt a(t, number);
    const Outcome outcome = try_once(a);
    if (outcome == Outcome::clean && end_of_work(a)) return commit_attempt(a);
    take_back(a);
    if (has_stopped(exec.meter)) {
      forget_attempts(w);
      return fail_stopped(issue, *exec.meter);
    }
    // The same attempt again, with all candidates tested.
    if (outcome == Outcome::doubtful) {
      t.has_doubts = true;
      continue;
    }
    // The same attempt again, with all contacts from the start.
    if (outcome == Outcome::blocked && a.hashed) {
      t.by_hash = false;
      t.allowance = {};
      continue;
    }
    if (outcome == Outcome::limit) {
      forget_attempts(w);
      return issue.status;
    }
    grow_frozen(w, outcome == Outcome::excess ? whole_mesh : a.rule.frozen_rings);
    number = outcome == Outcome::excess ? last_attempt(mode) : number + 1;
  }
}

}  // namespace tpa
