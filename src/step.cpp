#include "step.h"

#include <string.h>

#include "components.h"
#include "give_way.h"
#include "order.h"
#include "passes.h"

namespace tpa {

namespace {

// After this many attempts everything stays as it was: in a step the old mesh was clean, so this ends.
constexpr u32 most_attempts = 12;

void move_to_targets(Attempt& a) {
  Workspace& w = a.w;
  a.moved = false;
  if (a.mode != Mode::step || !w.context.has_targets) return;
  for (u32 v = 0; v < w.edit.mesh.vertex_count; ++v) {
    if (w.target_mark[v] == no_target) continue;
    const bool there = w.target[v] == w.edit.mesh.position[v];
    w.target_mark[v] = there ? target_reached : w.frozen[v] == free_vertex ? target_taken : target_refused;
    if (w.target_mark[v] != target_taken) continue;
    set_position(w.edit, v, w.target[v]);
    a.moved = true;
  }
}

// ---------------------------------------------------------------- results

void note_rolled_back(Attempt& a) {
  Workspace& w = a.w;
  u32 count = 0;
  for (u32 v = 0; v < w.edit.journal.vertex_count; ++v)
    if (w.target_mark[v] == target_refused) ++count;
  a.report.rolled_back_vertices = count;
  if (count > 0) add_event(a, TPA_EVENT_ROLLBACK, count, TPA_NONE, TPA_NONE, a.blocked_at);
}

void publish_rolled_back(Workspace& w, Mode mode) {
  w.rolled_back.clear();
  if (mode == Mode::adapt) return;
  for (u32 v = 0; v < w.edit.journal.vertex_count; ++v)
    if (w.target_mark[v] == target_refused && w.old_to_new[v] != none)
      w.rolled_back.push(w.old_to_new[v]);
  sort_in_place(w.rolled_back.data, w.rolled_back.size);
}

// Calls emit(type, amount, change) for everything that happened to components. Reads vertex_origin, so it may be asked
// before and after the commit; only the ids afterwards differ.
template <class Emit>
void describe_components(Workspace& w, Emit emit) {
  find_components(w.edit.mesh, w.after, w.work_vertices.data);
  for_each_change(w.edit.mesh, w.before, w.after, [&](const ComponentChange& c) {
    const auto say = [&](i32 type, i64 amount) { emit(type, static_cast<u32>(amount), c); };
    if (c.before_count == 0) {
      say(TPA_EVENT_BIRTH, 1);
      return;
    }
    if (c.after_count == 0) {
      say(TPA_EVENT_DEATH, c.before_count);
      return;
    }
    if (c.before_count > 1) say(TPA_EVENT_MERGE, c.before_count);
    if (c.after_count > 1) say(TPA_EVENT_SPLIT, c.after_count);
    if (c.genus_after > c.genus_before) say(TPA_EVENT_GENUS_UP, c.genus_after - c.genus_before);
    if (c.genus_after < c.genus_before) say(TPA_EVENT_GENUS_DOWN, c.genus_before - c.genus_after);
  });
}

// What describe_components() has found is how they are before the next step.
void keep_components(Workspace& w) {
  memcpy(w.before.label, w.after.label, w.edit.mesh.vertex_count * sizeof(u32));
  memcpy(w.before.list.data, w.after.list.data, w.after.list.size * sizeof(Component));
  w.before.list.size = w.after.list.size;
  w.context.components_known = true;
}

// The last thing that can fail: all events must fit. Each family of components has at most three of its own; they are
// counted only where that bound does not suffice.
bool events_fit(Attempt& a) {
  const Stack<tpa_event>& events = a.w.pending_events;
  u64 wanted = u64{events.size} + a.events_lost;
  if (a.changed) {
    const u64 bound = 3 * (u64{a.w.before.list.size} + a.report.caps + 1);
    if (wanted + bound <= events.capacity) return true;
    describe_components(a.w, [&](i32, u32, const ComponentChange&) { ++wanted; });
  }
  if (wanted <= events.capacity) return true;
  fail_limit(a.issue, TPA_LIMIT_EVENTS, wanted, events.capacity);
  return false;
}

void clear_report(tpa_report& report) {
  const u32 size = report.struct_size;
  report = {};
  report.struct_size = size;
}

}  // namespace

void publish(Workspace& w) {
  Context& c = w.context;
  reset_map(w.edit, w.old_to_new, c.old_vertex_count);
  commit(w.edit, w.old_to_new);
  c.old_vertex_count = w.edit.journal.vertex_count;
  c.old_face_count = w.edit.journal.face_count;
  note_peak(c, Measure::vertices, w.edit.mesh.vertex_count);
  note_peak(c, Measure::triangles, w.edit.mesh.face_count);
  c.components_known = false;
  ++c.epoch;
}

tpa_status run_transaction(Workspace& w, Mode mode, const Exec& exec, tpa_report& report, tpa_issue& issue) {
  w.relocation.detection = &w.detection;
  memset(w.frozen, 0, w.edit.mesh.vertex_count);
  memset(w.next_time, 0, w.edit.mesh.vertex_count);
  Attempt a{w, 0, mode, exec, report, issue};
  for (;; ++a.number) {
    clear_report(report);
    w.pending_events.clear();
    a.events_lost = 0;
    a.changed = a.halved = a.tangled = false;
    begin(w.edit);
    move_to_targets(a);
    if (mode == Mode::adapt && a.number == most_attempts) break;
    const Outcome outcome = run_passes(a);
    if (outcome == Outcome::clean) break;
    clear(w.regions);
    rollback(w.edit);
    if (outcome == Outcome::limit) return issue.status;
    grow_frozen(w, 1u << (a.number - min_of(a.number, widening_attempts)));
    if (a.number + 2 >= most_attempts) memset(w.frozen, frozen_vertex, w.edit.mesh.vertex_count);
  }
  if (mode == Mode::step) note_rolled_back(a);
  if (!events_fit(a)) {
    rollback(w.edit);
    return issue.status;
  }
  Context& c = w.context;
  const bool components_known = c.components_known;
  publish(w);
  publish_rolled_back(w, mode);
  if (a.changed) {
    describe_components(w, [&](i32 type, u32 amount, const ComponentChange& change) {
      add_event(a, type, amount, change.before, change.after, {});
    });
    keep_components(w);
  } else {
    c.components_known = components_known;
  }
  memcpy(region_data<tpa_event>(c, region_events), w.pending_events.data, w.pending_events.size * sizeof(tpa_event));
  c.event_count = w.pending_events.size;
  note_peak(c, Measure::events, c.event_count);
  c.known_clean = true;
  if (mode == Mode::adapt && (a.tangled || a.number == most_attempts)) {
    detect_all(w, exec);
    report.unresolved = static_cast<u32>(min_of(w.detection.found, u64{UINT32_MAX}));
    c.known_clean = w.detection.found == 0;
  }
  return TPA_OK;
}

}  // namespace tpa
