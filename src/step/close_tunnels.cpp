// SPDX-License-Identifier: MIT
#include "step/close_tunnels.h"

#include "step/allowance.h"
#include "step/region_check.h"
#include "surgery/pinch.h"

namespace tpa {

namespace {

i64 sum_of_genera(const Components& c) {
  i64 sum = 0;
  for (const Component& part : c.list) sum += genus_of(part.euler);
  return sum;
}

// Handles of all components, more than before the step.
i64 handles_made(Attempt& a) {
  Workspace& w = a.w;
  spend(a.meter(), w.edit.mesh.face_count / 2);
  find_components(w.edit.mesh, w.after, w.work_vertices.data);
  return sum_of_genera(w.after) - sum_of_genera(w.before);
}

ShortLoopSearch open_search(const Workspace& w) {
  const Scratch scratch = open_scratch(w.context);
  ShortLoopSearch s;
  s.way = scratch.way_near();
  s.towards = scratch.towards_near();
  s.near = w.relocation.vertex_mark;
  s.face_mark = w.relocation.face_mark;
  s.heap = {scratch.heap_near(), most_heap_entries};
  s.vertices = w.relocation.vertices;
  s.faces = w.relocation.faces;
  s.meter = w.near_faces.meter;
  return s;
}

// Changes the region by `most`, six times a volume, at most.
Outcome pinch_loop(Attempt& a, const ShortLoop& loop, f64 most, bool& done) {
  Workspace& w = a.w;
  // For the longest loop: a later one may need more, and what an issue names is to be enough.
  constexpr u64 cuts = 2 * longest_short_loop;
  if (const Outcome o = check_amount(a, TPA_LIMIT_CUT, cuts, not_known, w.context.limits.cuts); o != Outcome::clean)
    return o;
  const CandidateOptions options{w.context.config.max_candidates, {}};
  switch (pinch(w.edit, w.near_faces, loop, w.clusters, w.closing, options, w.relocation.face_mark, most, a.region)) {
    case PinchOutcome::vertices: return out_of_vertices(a);
    case PinchOutcome::triangles: return out_of_triangles(a);
    case PinchOutcome::blocked: return Outcome::clean;
    case PinchOutcome::done: break;
  }
  done = true;
  a.t.report.caps += 2;
  add_event(a, TPA_EVENT_CAP, 2, TPA_NONE, TPA_NONE, w.edit.mesh.position[tail(w.edit.mesh, loop.half_edge[0])]);
  return Outcome::clean;
}

// Closes tunnels through or near a vertex, if longer than those tried before.
Outcome close_near(Attempt& a, u32 v, const LoopLengths& tried, const LoopLengths& longest, f64 allowed, i64& left) {
  for (u32 skipped = 0; skipped < most_loops_cut && left > 0;) {
    ShortLoopSearch search = open_search(a.w);
    ShortLoop loop;
    if (!find_short_loop(a.w.edit.mesh, v, tried, longest, skipped, search, loop)) return Outcome::clean;
    if (has_stopped(a.meter())) return Outcome::stopped;
    bool done = false;
    if (const Outcome o = pinch_loop(a, loop, allowed - a.region.volume(), done); o != Outcome::clean) return o;
    left -= done ? 1 : 0;
    skipped = done ? 0 : skipped + 1;
  }
  return Outcome::clean;
}

// Short loops first: they lie where a tunnel is thinnest. The region changes by a volume of `allowed` at most in all.
Outcome close_all(Attempt& a, const CutSizes& sizes, f64 allowed, i64& left) {
  constexpr f64 shares[] = {0.0625, 0.125, 0.25, 0.5, 1};
  const f64 flat = max_of(tunnel_share * sizes.triangle, flat_share * sizes.longest);
  const Mesh& m = a.w.edit.mesh;
  LoopLengths tried;
  for (f64 share : shares) {
    const LoopLengths longest{share * tunnel_share * sizes.triangle, share * flat,
                              share * handle_share * sizes.triangle};
    for (u32 v : a.w.edit.journal.vertices) {
      if (left <= 0) return Outcome::clean;
      if (has_stopped(a.meter())) return Outcome::stopped;
      if (v >= m.vertex_count || !vertex_lives(m, v) || is_old(m, v)) continue;
      if (const Outcome o = close_near(a, v, tried, longest, allowed, left); o != Outcome::clean) return o;
    }
    tried = longest;
  }
  return Outcome::clean;
}

}  // namespace

Outcome close_tunnels(Attempt& a, const CutSizes& sizes) {
  const i64 made = handles_made(a);
  if (made <= 0) return Outcome::clean;
  i64 left = made;
  spend(a.meter(), a.w.edit.mesh.face_count / 4);
  const f64 allowed = a.region.volume() + closing_share * six_volumes(a.w.edit.mesh, a.t.exec);
  const Outcome outcome = close_all(a, sizes, allowed, left);
  if (outcome == Outcome::clean && left < made) drop_specks(a, sizes);
  return outcome;
}

}  // namespace tpa
