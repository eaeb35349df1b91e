#include "step.h"

#include <string.h>

#include "order.h"

namespace tpa {

namespace {

// Per vertex: keeps its old position (step), or keeps its contacts (adapt).
enum : u8 { free_vertex = 0, frozen_vertex = 1, newly_frozen = 2 };

// Per vertex: no target given; it is there already; it goes there; it is frozen and stays behind. tpa_move writes 1.
enum : u8 { no_target = 0, target_reached = 1, target_taken = 2, target_refused = 3 };

// A group that cannot be connected is first cut out more widely, ring by ring, in this many attempts; then it is rolled
// back.
constexpr u32 widening_attempts = 3;

// After this many attempts everything stays: the old mesh was clean, so this ends.
constexpr u32 most_attempts = 9;

enum class Outcome { clean, blocked, limit };

struct Attempt {
  Workspace& w;
  u32 number;
  Mode mode;
  const Exec& exec;
  tpa_report& report;
  tpa_issue& issue;
  u64 events_lost = 0;
};

void add_event(Attempt& a, i32 type, u32 amount, u32 before, u32 after, Vec3 where) {
  Stack<tpa_event>& events = a.w.pending_events;
  if (!events.push({type, amount, before, after, {where.x, where.y, where.z}})) ++a.events_lost;
}

// ---------------------------------------------------------------- rolling back

void freeze(Attempt& a, u32 v) {
  const VertexOrigin& o = a.w.edit.mesh.vertex_origin[v];
  for (u32 parent : o.parents)
    if (parent != none && a.w.frozen[parent] == free_vertex) a.w.frozen[parent] = newly_frozen;
}

// Next time the group takes the vertices just outside its loops along, or stays where it was.
void give_way(Attempt& a, const Group& group) {
  const Regions& r = a.w.regions;
  for (u32 i = 0; i < group.loops; ++i) {
    const CutLoop& loop = r.loops[group.first_loop + i];
    for (u32 k = 0; k < loop.count; ++k) {
      const u32 v = r.cuts[loop.first + k].vertex;
      if (a.number >= widening_attempts) {
        freeze(a, v);
        continue;
      }
      for (u32 parent : a.w.edit.mesh.vertex_origin[v].parents)
        if (parent != none) a.w.widened[parent] = 1;
    }
  }
}

void freeze_contacts(Attempt& a) {
  for (const Contact& c : a.w.detection.pairs)
    for (u32 i = 0; i < 3; ++i) {
      freeze(a, a.w.edit.mesh.corner[3 * c.a + i]);
      freeze(a, a.w.edit.mesh.corner[3 * c.b + i]);
    }
}

// On the old mesh again: the newly frozen vertices take their surroundings along, twice as far with each attempt.
void grow_frozen(Workspace& w, u32 rings) {
  const Mesh& m = w.edit.mesh;
  Stack<u32>& front = w.work_vertices;
  front.clear();
  for (u32 v = 0; v < m.vertex_count; ++v)
    if (w.frozen[v] == newly_frozen) {
      w.frozen[v] = frozen_vertex;
      front.push(v);
    }
  u32 begin = 0;
  for (u32 ring = 0; ring < rings; ++ring) {
    const u32 end = front.size;
    for (; begin < end; ++begin)
      for_each_outgoing(m, front[begin], [&](u32 h) {
        const u32 u = head(m, h);
        if (w.frozen[u] == frozen_vertex) return;
        w.frozen[u] = frozen_vertex;
        front.push(u);
      });
  }
}

// ---------------------------------------------------------------- one pass

// Marks the faces that moved, or all; nullptr stands for all.
const u8* mark_moved_faces(Attempt& a) {
  Workspace& w = a.w;
  if (a.mode == Mode::adapt) return nullptr;
  const Mesh& m = w.edit.mesh;
  u8* mark = w.relocation.face_mark;
  const auto moved = [&](u32 v) { return w.target_mark[v] == target_taken; };
  for (u32 f = 0; f < m.face_count; ++f)
    mark[f] = moved(m.corner[3 * f]) || moved(m.corner[3 * f + 1]) || moved(m.corner[3 * f + 2]) ? 1 : 0;
  return mark;
}

void detect_first(Attempt& a) {
  Workspace& w = a.w;
  const u8* active = mark_moved_faces(a);
  detect(w.edit.mesh, w.grid, {active, {}, w.relocation.star}, a.exec, w.detection);
  memset(w.relocation.star, 0, w.edit.mesh.vertex_count);
  if (active != nullptr) memset(w.relocation.face_mark, 0, w.edit.mesh.face_count);
}

// Later passes: only the faces round the vertices of the last events are new.
void detect_again(Attempt& a) {
  Workspace& w = a.w;
  Relocation& r = w.relocation;
  r.faces.clear();
  for (u32 v : w.work_vertices)
    for_each_outgoing(w.edit.mesh, v, [&](u32 h) {
      const u32 f = face_of(h);
      if (r.face_mark[f] != 0) return;
      r.face_mark[f] = 1;
      r.faces.push(f);
    });
  detect_around(w.edit.mesh, w.grid, a.exec, r);
}

// adapt: contacts that an earlier attempt could not resolve are left alone.
void drop_frozen_contacts(Attempt& a) {
  if (a.mode == Mode::step) return;
  const Mesh& m = a.w.edit.mesh;
  const auto stuck = [&](u32 f) {
    for (u32 i = 0; i < 3; ++i)
      for (u32 parent : m.vertex_origin[m.corner[3 * f + i]].parents)
        if (parent != none && a.w.frozen[parent] != free_vertex) return true;
    return false;
  };
  u32 kept = 0;
  for (const Contact& c : a.w.detection.pairs)
    if (!stuck(c.a) && !stuck(c.b)) a.w.detection.pairs[kept++] = c;
  a.w.detection.pairs.size = kept;
}

Vec3 mean_of_loops(const Attempt& a, const Group& group) {
  const Regions& r = a.w.regions;
  Vec3 sum;
  u32 n = 0;
  for (u32 i = 0; i < group.loops; ++i) {
    const CutLoop& loop = r.loops[group.first_loop + i];
    for (u32 k = 0; k < loop.count; ++k, ++n) sum = sum + a.w.edit.mesh.position[r.cuts[loop.first + k].vertex];
  }
  return n == 0 ? sum : 1.0 / n * sum;
}

void record(Attempt& a, const Group& group, const GroupOutcome& outcome) {
  const Vec3 where = mean_of_loops(a, group);
  if (outcome.joined >= 2) {
    ++a.report.handles[min_of(outcome.joined, 5u) - 2];
    add_event(a, TPA_EVENT_HANDLE, outcome.joined, TPA_NONE, TPA_NONE, where);
  }
  if (outcome.capped > 0) {
    a.report.caps += outcome.capped;
    add_event(a, TPA_EVENT_CAP, outcome.capped, TPA_NONE, TPA_NONE, where);
  }
}

// The new vertices and one ring round them, each once, into work_vertices.
void collect_neighbourhood(Attempt& a) {
  Workspace& w = a.w;
  const Regions& r = w.regions;
  w.work_vertices.clear();
  u8* mark = w.relocation.vertex_mark;
  const auto add = [&](u32 v) {
    if (mark[v] != 0) return;
    mark[v] = 1;
    w.work_vertices.push(v);
  };
  for (const CutLoop& loop : r.loops)
    for (u32 k = 0; k < loop.count; ++k) {
      const u32 v = r.cuts[loop.first + k].vertex;
      add(v);
      for_each_outgoing(w.edit.mesh, v, [&](u32 h) { add(head(w.edit.mesh, h)); });
    }
  for (u32 v : w.work_vertices) mark[v] = 0;
}

Outcome find_regions(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  const Span<const Contact> contacts = w.detection.pairs.span();
  clear(w.regions);
  gather(m, contacts, w.widened, w.regions);
  u64 cuts = 0;
  if (!find_loops(m, w.regions, cuts)) {
    fail_limit(a.issue, TPA_LIMIT_CUT, cuts, w.context.limits.cuts);
    return Outcome::limit;
  }
  note_peak(w.context, Measure::cuts, cuts);
  judge_patches(m, w.grid, w.context.config.region == TPA_REGION_OUTSIDE ? 1 : 0, w.regions);
  if (!form_groups(m, contacts, w.regions)) {
    fail_limit(a.issue, TPA_LIMIT_CUT, contacts.size, w.context.limits.cuts);
    return Outcome::limit;
  }
  return Outcome::clean;
}

Outcome connect_groups(Attempt& a) {
  Workspace& w = a.w;
  const tpa_config& config = w.context.config;
  const CandidateOptions options{config.max_candidates, config.handle_order == TPA_HANDLES_SHORTEST_FIRST, {}};
  Outcome result = Outcome::clean;
  for (const Group& group : w.regions.groups) {
    const GroupOutcome outcome = connect_group(w.edit, w.grid, w.regions, group, options, w.plan);
    if (outcome.out_of_faces) {
      fail_limit(a.issue, TPA_LIMIT_TRIANGLES, u64{w.context.limits.triangles} + 1, w.context.limits.triangles);
      return Outcome::limit;
    }
    if (outcome.done) {
      record(a, group, outcome);
    } else {
      give_way(a, group);
      result = Outcome::blocked;
    }
  }
  return result;
}

// Regions, cut, handles, smoothing, for the contacts at hand.
Outcome resolve_contacts(Attempt& a) {
  Workspace& w = a.w;
  if (const Outcome found = find_regions(a); found != Outcome::clean) return found;
  const Regions& r = w.regions;
  a.report.groups += r.groups.size;
  a.report.removed_patches += r.removed_patches;
  if (r.removed_patches > 0)
    add_event(a, TPA_EVENT_REMOVAL, r.removed_patch_vertices, TPA_NONE, TPA_NONE, {});
  if (!cut(w.edit, w.grid, w.regions)) {
    const Mesh& m = w.edit.mesh;
    const bool vertices = m.vertex_count == m.vertex_capacity;
    u64 cuts = 0;
    for (const CutLoop& loop : r.loops) cuts += loop.count;
    fail_limit(a.issue, vertices ? TPA_LIMIT_VERTICES : TPA_LIMIT_TRIANGLES,
               vertices ? w.edit.journal.vertex_count + cuts : u64{m.face_capacity} + cuts,
               vertices ? m.vertex_capacity : m.face_capacity);
    return Outcome::limit;
  }
  note_peak(w.context, Measure::vertices, w.edit.mesh.vertex_count);
  if (const Outcome connected = connect_groups(a); connected != Outcome::clean) return connected;
  note_peak(w.context, Measure::triangles, w.edit.mesh.face_count);
  collect_neighbourhood(a);
  const tpa_config& config = w.context.config;
  smooth(w.edit, w.grid, w.work_vertices.span(), config.smooth_iterations, {config.smooth_lambda, config.smooth_mu},
         a.exec, w.relocation);
  clear(w.regions);
  return Outcome::clean;
}

Outcome run_passes(Attempt& a) {
  Workspace& w = a.w;
  rebuild(w.grid, w.edit.mesh);
  for (u32 pass = 0; pass <= w.context.config.max_passes; ++pass) {
    if (pass == 0)
      detect_first(a);
    else
      detect_again(a);
    note_peak(w.context, Measure::contacts, w.detection.found);
    if (w.detection.found > w.detection.pairs.capacity) {
      fail_limit(a.issue, TPA_LIMIT_CONTACTS, w.detection.found, w.detection.pairs.capacity);
      return Outcome::limit;
    }
    drop_frozen_contacts(a);
    if (w.detection.pairs.empty()) return Outcome::clean;
    if (pass == w.context.config.max_passes) break;
    if (pass == 0) {
      a.report.contacts = w.detection.pairs.size;
      find_components(w.edit.mesh, w.before, w.work_vertices.data);
    }
    ++a.report.passes;
    if (const Outcome o = resolve_contacts(a); o != Outcome::clean) return o;
  }
  freeze_contacts(a);
  return Outcome::blocked;
}

void move_to_targets(Attempt& a) {
  Workspace& w = a.w;
  if (a.mode != Mode::step || !w.context.has_targets) return;
  for (u32 v = 0; v < w.edit.mesh.vertex_count; ++v) {
    if (w.target_mark[v] == no_target) continue;
    const bool there = w.target[v] == w.edit.mesh.position[v];
    w.target_mark[v] = there ? target_reached : w.frozen[v] == free_vertex ? target_taken : target_refused;
    if (w.target_mark[v] == target_taken) set_position(w.edit, v, w.target[v]);
  }
}

// ---------------------------------------------------------------- results

void note_rolled_back(Attempt& a) {
  Workspace& w = a.w;
  u32 count = 0;
  for (u32 v = 0; v < w.edit.journal.vertex_count; ++v)
    if (w.target_mark[v] == target_refused) ++count;
  a.report.rolled_back_vertices = count;
  if (count > 0) add_event(a, TPA_EVENT_ROLLBACK, count, TPA_NONE, TPA_NONE, {});
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

// The last thing that can fail: all events must fit. Each family of components has at most three of its own; they are
// counted only where that bound does not suffice.
bool events_fit(Attempt& a) {
  const Stack<tpa_event>& events = a.w.pending_events;
  u64 wanted = u64{events.size} + a.events_lost;
  if (a.report.contacts > 0) {
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

tpa_status fail_limit(tpa_issue& issue, i32 limit, u64 needed, u64 available) {
  issue = {};
  issue.status = TPA_E_LIMIT;
  issue.limit = limit;
  issue.needed = needed;
  issue.available = available;
  return TPA_E_LIMIT;
}

void detect_all(Workspace& w, const Exec& exec) {
  rebuild(w.grid, w.edit.mesh);
  detect(w.edit.mesh, w.grid, {nullptr, {}, w.relocation.star}, exec, w.detection);
  memset(w.relocation.star, 0, w.edit.mesh.vertex_count);
  note_peak(w.context, Measure::contacts, w.detection.found);
}

void publish(Workspace& w) {
  Context& c = w.context;
  reset_map(w.edit, w.old_to_new, c.old_vertex_count);
  commit(w.edit, w.old_to_new);
  c.old_vertex_count = w.edit.journal.vertex_count;
  c.old_face_count = w.edit.journal.face_count;
  note_peak(c, Measure::vertices, w.edit.mesh.vertex_count);
  note_peak(c, Measure::triangles, w.edit.mesh.face_count);
  ++c.epoch;
}

tpa_status run_transaction(Workspace& w, Mode mode, const Exec& exec, tpa_report& report, tpa_issue& issue) {
  w.relocation.detection = &w.detection;
  memset(w.frozen, 0, w.edit.mesh.vertex_count);
  memset(w.widened, 0, w.edit.mesh.vertex_count);
  Attempt a{w, 0, mode, exec, report, issue};
  for (;; ++a.number) {
    clear_report(report);
    w.pending_events.clear();
    a.events_lost = 0;
    begin(w.edit);
    move_to_targets(a);
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
  publish(w);
  publish_rolled_back(w, mode);
  if (report.contacts > 0)
    describe_components(w, [&](i32 type, u32 amount, const ComponentChange& c) {
      add_event(a, type, amount, c.before, c.after, {});
    });
  Context& c = w.context;
  memcpy(region_data<tpa_event>(c, region_events), w.pending_events.data, w.pending_events.size * sizeof(tpa_event));
  c.event_count = w.pending_events.size;
  note_peak(c, Measure::events, c.event_count);
  c.known_clean = true;
  if (mode == Mode::adapt && a.number > 0) {
    detect_all(w, exec);
    report.unresolved = static_cast<u32>(min_of(w.detection.found, u64{UINT32_MAX}));
    c.known_clean = w.detection.found == 0;
  }
  return TPA_OK;
}

}  // namespace tpa
