#include "step/transaction.h"

#include <string.h>

#include "mesh/volume.h"
#include "step/fallback.h"
#include "step/passes.h"

namespace tpa {

namespace {

// After this many attempts everything stays as it was: in a step the old mesh was clean, so this ends.
constexpr u32 most_attempts = 12;

// Two vertices whose ways end at most r from the mean of all come nearer to each other by at most 2 r, and so do two
// points of faces, whose ways lie between those of the corners. Most moves are near a common one.
f64 bound_of_approach(const Workspace& w) {
  const Vec3* position = w.edit.mesh.position;
  const auto way = [&](u32 v) {
    return state_of(w, v, frozen_state) == free_vertex ? w.target[v] - position[v] : Vec3{};
  };
  Vec3 sum = {};
  for (u32 v : w.targets) sum = sum + way(v);
  const u32 count = w.edit.mesh.vertex_count;
  const Vec3 mean = (count > 0 ? 1.0 / count : 0) * sum;
  f64 farthest = w.context.target_count < count ? squared_length(mean) : 0;
  for (u32 v : w.targets) farthest = max_of(farthest, squared_length(way(v) - mean));
  // Rounded up: each way is off by half a unit in the last place, what is made of them by four at most.
  const f64 r = square_root(farthest);
  return 2 * (r + 0x1p-51 * (r + size_of(mean)));
}

void move_to_targets(Attempt& a) {
  Workspace& w = a.w;
  a.moved = a.refused = 0;
  if (a.mode != Mode::step) return;
  a.report.approach = bound_of_approach(w);
  for (u32 v : w.targets) {
    const bool there = w.target[v] == w.edit.mesh.position[v];
    const bool free = state_of(w, v, frozen_state) == free_vertex;
    const u8 state = there ? target_reached : free ? target_taken : target_refused;
    set_state(w, v, target_state, state);
    a.refused += state == target_refused ? 1 : 0;
    if (state != target_taken) continue;
    set_position(w.edit, v, w.target[v]);
    ++a.moved;
  }
}

// ---------------------------------------------------------------- results

void note_rolled_back(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  u32 count = 0;  // but for those that were removed; their slots may be others' now
  for (u32 v : w.targets)
    count += state_of(w, v, target_state) == target_refused && vertex_lives(m, v) && is_old(m, v) ? 1 : 0;
  a.report.rolled_back_vertices = count;
  if (count > 0) add_event(a, TPA_EVENT_ROLLBACK, count, TPA_NONE, TPA_NONE, a.blocked_at);
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

// Calls emit(type, amount, family) for everything that happened to components.
template <class Emit>
void describe_components(const Parts& parts, Emit emit) {
  for_each_change(parts, [&](const Family& f) {
    const auto say = [&](i32 type, u32 amount) { emit(type, amount, f); };
    if (f.after_count == 0) {
      say(TPA_EVENT_DEATH, f.before_count);
      return;
    }
    if (f.before_count > 1) say(TPA_EVENT_MERGE, f.before_count);
    if (f.after_count > 1) say(TPA_EVENT_SPLIT, f.after_count);
    if (f.genus_after > f.genus_before) say(TPA_EVENT_GENUS_UP, static_cast<u32>(f.genus_after - f.genus_before));
    if (f.genus_after < f.genus_before) say(TPA_EVENT_GENUS_DOWN, static_cast<u32>(f.genus_before - f.genus_after));
  });
}

// The last thing that can fail: all events must fit.
bool events_fit(Attempt& a) {
  const Stack<tpa_event>& events = a.w.pending_events;
  u64 wanted = u64{events.size} + a.events_lost;
  if (a.changed) describe_components(a.w.parts, [&](i32, u32, const Family&) { ++wanted; });
  if (wanted <= events.capacity) return true;
  fail_limit(a.issue, TPA_LIMIT_EVENTS, wanted, events.capacity);
  return false;
}

bool components_fit(Attempt& a) {
  if (!a.changed) return true;
  const u32 wanted = count_components(a.w.before, a.w.parts), capacity = a.w.before.list.capacity;
  if (wanted <= capacity) return true;
  fail_limit(a.issue, TPA_LIMIT_COMPONENTS, wanted, capacity);
  return false;
}

void freeze_all(Workspace& w) {
  for (u32 v = 0; v < w.edit.mesh.vertex_count; ++v) set_state(w, v, frozen_state, frozen_vertex);
}

// What attempts have noted for the next ones.
void forget_attempts(Workspace& w) {
  for (u32 v = 0; v < w.context.limits.vertices; ++v) w.marks[v] &= target_state;
}

// Everything is as it was. Only later attempts set faces aside, which the tree would lack.
void take_back(Attempt& a) {
  Workspace& w = a.w;
  clear(w.clusters);
  a.near_faces_stand = a.near_faces_stand && a.moves_few() && a.as_in_the_paper();
  if (a.near_faces_stand) {
    rollback(w.edit, w.near_faces);
  } else {
    rollback(w.edit);
    w.near_faces.tree = nullptr;
  }
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
  commit(w.edit, w.old_to_new, w.before.label);
  if (w.near_faces.tree != nullptr) renumber(w.near_faces, w.edit.mesh, w.edit.journal.faces);
  forget_unmapped(w.edit, w.old_to_new);
  c.old_vertex_count = w.edit.journal.vertex_count;
  c.old_face_count = w.edit.journal.face_count;
  note_peak(c, Measure::vertices, w.edit.mesh.vertex_count);
  note_peak(c, Measure::triangles, w.edit.mesh.face_count);
  c.components_known = false;
  ++c.epoch;
}

tpa_status run_transaction(Workspace& w, Mode mode, const Exec& exec, tpa_report& report, tpa_issue& issue) {
  w.relocation.detection = &w.detection;
  Attempt a{w, 0, mode, exec, report, issue};
  a.near_faces_stand = w.context.near_faces_stand;
  if (a.near_faces_stand) resume(w.near_faces, w.edit.mesh, w.tree, w.context.tree);
  w.context.near_faces_stand = false;
  for (;; ++a.number) {
    clear_report(report);
    w.pending_events.clear();
    a.events_lost = 0;
    a.changed = a.halved = a.tangled = a.parts_known = a.trusts = false;
    begin(w.edit);
    move_to_targets(a);
    if (mode == Mode::adapt && a.number == most_attempts) break;
    const Outcome outcome = run_passes(a);
    if (outcome == Outcome::clean) break;
    take_back(a);
    // What was halved for the sake of others is not worth a failure.
    const bool can_spare = outcome == Outcome::limit && mode == Mode::step && a.halved && a.spares_hubs;
    if (can_spare) a.spares_hubs = false;
    if (outcome == Outcome::doubtful) a.has_doubts = true;
    if (can_spare || outcome == Outcome::doubtful) {
      issue = {};
      --a.number;
      continue;
    }
    if (outcome == Outcome::limit) {
      forget_attempts(w);
      return issue.status;
    }
    grow_frozen(w, 1u << (a.number - min_of(a.number, widening_attempts)));
    if (a.number + 2 >= most_attempts) freeze_all(w);
  }
  if (a.number > 0 || !a.spares_hubs) forget_attempts(w);
  if (a.refused > 0) note_rolled_back(a);
  if (a.changed && !a.parts_known) find_parts(w.edit, w.before, w.parts);
  if (!components_fit(a) || !events_fit(a)) {
    if (a.changed) forget_parts(w.before, w.parts);
    w.context.components_known = false;
    rollback(w.edit);
    return issue.status;
  }
  Context& c = w.context;
  const bool components_known = c.components_known;
  if (a.changed) {
    // Where most moved, they are measured when they are wanted: all at once.
    if (a.moves_few()) measure_parts(w.edit, w.before, w.parts);
    label_parts(w.before, w.parts);
  }
  publish(w);
  publish_rolled_back(w, a.refused);
  c.components_known = components_known;
  if (a.changed) {
    commit_parts(w.edit, w.before, w.parts);
    note_peak(c, Measure::components, w.before.list.size);
    describe_components(w.parts, [&](i32 type, u32 amount, const Family& family) {
      add_event(a, type, amount, family.before, family.after, {});
    });
    forget_parts(w.before, w.parts);
  }
  memcpy(table_data<tpa_event>(c, table_events), w.pending_events.data, w.pending_events.size * sizeof(tpa_event));
  c.event_count = w.pending_events.size;
  note_peak(c, Measure::events, c.event_count);
  c.known_clean = true;
  if (mode == Mode::adapt && (a.tangled || a.number == most_attempts)) {
    detect_all(w, exec);
    report.unresolved = static_cast<u32>(min_of(w.detection.found, u64{UINT32_MAX}));
    c.known_clean = w.detection.found == 0;
  } else if (a.near_faces_stand) {
    keep_near_faces(w);
  }
  return TPA_OK;
}

}  // namespace tpa
