// SPDX-License-Identifier: MIT
#include "step/advance.h"

#include <string.h>

#include "block/way_back.h"
#include "results/component_events.h"
#include "results/whole_components.h"
#include "results/whole_maps.h"
#include "step/approach.h"
#include "step/transaction.h"

namespace tpa {

namespace {

Vec3* goals(const Context& c) { return table_data<Vec3>(c, table_goal); }
BitSet open_left_behind(const Context& c) {
  return open_bit_set(table_data<u32>(c, table_left_behind), c.limits.vertices);
}

// ---------------------------------------------------------------- goals

// The goal of a vertex is where its way ends: its target; without a target, its position.
void begin_goals(Context& c) {
  const Vec3 *position = table_data<Vec3>(c, table_position), *target = table_data<Vec3>(c, table_target);
  const BitSet targets = open_targets(c);
  Vec3* goal = goals(c);
  for (u32 v = 0; v < c.vertex_count; ++v) goal[v] = targets.contains(v) ? target[v] : position[v];
}

// Targets of the next sub-step, the first of `left` equal parts of all ways. The table `target` has an entry for each
// vertex, the set only the vertices that move.
void aim(Workspace& w, u32 left) {
  const Vec3* goal = goals(w.context);
  for (u32 v = 0; v < w.edit.mesh.vertex_count; ++v) {
    const Vec3& p = w.edit.mesh.position[v];
    const Vec3 to = left == 1 ? goal[v] : into_exact_range(p + (1.0 / left) * (goal[v] - p));
    w.target[v] = to;
    if (!(to == p)) set_target(w, v, to);
  }
}

// After a sub-step. A vertex in the place aimed at keeps its goal. All others go the rest of their ways from where they
// are: vertices left behind, moved by smoothing, or new, which take the ways of their parents.
void carry_goals(Workspace& w) {
  const Mesh& m = w.edit.mesh;
  Vec3* goal = goals(w.context);
  Vec3* next = w.edit.journal.position;  // free between transactions
  const auto rest = [&](u32 u) { return goal[u] - w.target[u]; };
  for (u32 v = 0; v < m.vertex_count; ++v) {
    const Vec3& p = m.position[v];
    const VertexOrigin& o = m.vertex_origin[v];
    const u32 a = o.parents[0], b = o.parents[1];
    if (b == none)
      next[v] = p == w.target[a] ? goal[a] : into_exact_range(p + rest(a));
    else
      next[v] = into_exact_range(p + (f64{o.weight} * rest(a) + (1 - f64{o.weight}) * rest(b)));
  }
  memcpy(goal, next, m.vertex_count * sizeof *goal);
}

// ---------------------------------------------------------------- vertices left behind

void keep_left_behind(Context& c) {
  BitSet kept = open_left_behind(c);
  kept.clear();
  for (u32 v : open_rolled_back(c)) kept.add(v);
}

// Adds those of the sub-steps before to those of the last.
void add_left_behind(Workspace& w) {
  for (u32 u : open_left_behind(w.context)) {
    const u32 v = w.old_to_new[u];
    if (v != none && w.rolled_back.add(v)) ++w.context.rolled_back_count;
  }
}

// Where the budget ended before the last sub-step: adds all vertices that are not where their ways end.
void add_not_arrived(Workspace& w) {
  for (u32 v = 0; v < w.edit.mesh.vertex_count; ++v)
    if (!(w.edit.mesh.position[v] == goals(w.context)[v]) && w.rolled_back.add(v)) ++w.context.rolled_back_count;
}

// ---------------------------------------------------------------- sub-steps

void add_report(tpa_report& sum, const tpa_report& part) {
  sum.passes += part.passes;
  sum.contacts += part.contacts;
  sum.groups += part.groups;
  for (u32 i = 0; i < 4; ++i) sum.handles[i] += part.handles[i];
  sum.caps += part.caps;
  sum.removed_patches += part.removed_patches;
  sum.approach = max_of(sum.approach, part.approach);
  sum.region_lost += part.region_lost;
  sum.region_gained += part.region_gained;
  sum.region_reach = max_of(sum.region_reach, part.region_reach);
  sum.region_after = part.region_after;
  sum.unfinished += part.unfinished;
  ++sum.substeps;
}

struct SubstepPlan {
  u32 substeps;
  f64 approach;  // of a sub-step: the ways of new vertices lie between those of their parents
};

SubstepPlan plan_for(f64 approach, u64 substeps, f64 rounding) {
  return {static_cast<u32>(substeps), approach / static_cast<f64>(substeps) * (1 + 0x1p-24) + rounding};
}

tpa_status run_substep(Context& c, const SubstepPlan& plan, u32 left, const Exec& exec, tpa_report& sum,
                       tpa_issue& issue) {
  Workspace w = open(c);
  spend(exec.meter, w.edit.mesh.vertex_count);
  aim(w, left);
  keep_left_behind(c);
  tpa_report part{};
  const tpa_status status = run_transaction(w, Mode::step, Extent::part, exec, part, issue);
  if (status == TPA_OK) {
    carry_goals(w);
    add_left_behind(w);
    add_to_whole_maps(w);
    if (part.rolled_back_vertices == 0) part.approach = min_of(part.approach, plan.approach);
    add_report(sum, part);
  }
  close(w);
  if (status == TPA_OK) forget_targets(c);
  return status;
}

void begin_advance(Context& c) {
  keep_state(c);
  {
    Workspace w = open(c);
    note_first_components(w);
    close(w);
  }
  begin_goals(c);
  begin_whole_maps(c);
  forget_targets(c);
  forget_rolled_back(c);
  c.event_count = 0;
}

// The work before the first and after the last sub-step, for a mesh of this size.
u64 work_of_frame(const Context& c) { return u64{c.vertex_count} + c.face_count; }

// All sub-steps as one commit.
tpa_status end_advance(Context& c, tpa_report& report, const Exec& exec, tpa_issue& issue) {
  if (!end_within_budget(exec.meter, work_of_frame(c))) return fail_stopped(issue, *exec.meter);
  Workspace w = open(c);
  if (report.unfinished > 0) add_not_arrived(w);
  publish_whole_maps(w);
  relate_first_components(w);
  const u64 events = c.event_count + count_component_events(w.parts);
  note_peak(c, Measure::events, events);
  if (events > c.limits.events) return fail_limit(issue, TPA_LIMIT_EVENTS, events, c.limits.events);
  add_component_events(w);
  publish_events(w, c.event_count);
  close(w);
  report.rolled_back_vertices = c.rolled_back_count;
  report.region_before = report.region_after + report.region_lost - report.region_gained;
  return TPA_OK;
}

tpa_status run_step(Context& c, const Exec& exec, tpa_report& report, tpa_issue& issue) {
  Workspace w = open(c);
  const tpa_status status = run_transaction(w, Mode::step, Extent::whole, exec, report, issue);
  close(w);
  report.substeps = 1;
  return status;
}

struct WholeBounds {
  f64 approach;
  f64 rounding;  // for approaches of the thickness or more
};

// With a workspace of its own, whose memory on the stack is free again afterwards.
[[gnu::noinline]] WholeBounds bounds_of_call(Context& c, f64 thickness) {
  const Workspace w = open(c);
  const f64 approach = bound_of_approach(w);
  return {approach, approach < thickness ? 0 : rounding_of_substeps(w)};
}

}  // namespace

tpa_status run_advance(Context& c, f64 thickness, const Exec& exec, tpa_report& report, tpa_issue& issue) {
  const auto [approach, rounding] = bounds_of_call(c, thickness);
  if (approach < thickness) return run_step(c, exec, report, issue);
  const u64 substeps = substeps_for(approach, thickness, rounding);
  note_peak(c, Measure::substeps, substeps);
  if (substeps > c.limits.substeps) return fail_limit(issue, TPA_LIMIT_SUBSTEPS, substeps, c.limits.substeps);
  spend(exec.meter, work_of_frame(c));
  if (has_stopped(exec.meter)) return fail_stopped(issue, *exec.meter);
  begin_advance(c);
  const SubstepPlan plan = plan_for(approach, substeps, rounding);
  tpa_status status = TPA_OK;
  for (u32 left = plan.substeps; left > 0 && status == TPA_OK && report.unfinished == 0; --left)
    status = run_substep(c, plan, left, exec, report, issue);
  if (status == TPA_OK) status = end_advance(c, report, exec, issue);
  if (status != TPA_OK) take_back_all(c);
  return status;
}

}  // namespace tpa
