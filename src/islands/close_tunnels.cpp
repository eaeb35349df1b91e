// SPDX-License-Identifier: MIT
#include "islands/close_tunnels.h"

#include "islands/allowance.h"
#include "islands/rules.h"
#include "surgery/pinch.h"

namespace tpa {

namespace {

ShortLoopSearch open_search(const Workspace& w) {
  const Scratch scratch = open_scratch(w.context);
  const Relocation& r = w.relocation;
  return {scratch.way_near(),
          scratch.towards_near(),
          r.vertex_mark,
          r.face_mark,
          {scratch.heap_near(), most_heap_entries, 0},
          r.vertices,
          r.faces,
          w.near_faces.meter};
}

Outcome pinch_loop(Attempt& a, const ShortLoop& loop, PinchOutcome& pinched) {
  Workspace& w = a.w;
  // For the longest loop: a later one may need more, and what an issue names is to be enough.
  constexpr u64 cuts = 2 * longest_short_loop;
  if (const Outcome o = check_amount(a, TPA_LIMIT_CUT, cuts, not_known, w.context.limits.cuts); o != Outcome::clean)
    return o;
  const CandidateOptions options{w.context.config.max_candidates, {}};
  pinched = pinch(w.edit, w.near_faces, loop, w.clusters, w.closing, options, w.relocation.face_mark,
                  a.left_in_ledger(), a.region);
  if (pinched == PinchOutcome::vertices) return out_of_vertices(a);
  if (pinched == PinchOutcome::triangles) return out_of_triangles(a);
  if (pinched != PinchOutcome::done) return Outcome::clean;
  a.t.report.caps += 2;
  add_event(a.t, TPA_EVENT_CAP, 2, TPA_NONE, TPA_NONE, w.edit.mesh.position[tail(w.edit.mesh, loop.half_edge[0])]);
  return Outcome::clean;
}

// Thin loops first: they lie where a tunnel is thinnest. A cut may close the tunnel of another loop, or leave a longer
// loop round it, so each is searched again before it is cut. A bridge of the paper is a handle as thin as the patches
// that it joins, and stays.
Outcome close_all(Attempt& a, const CutSizes& sizes, i64& left) {
  const Mesh& m = a.w.edit.mesh;
  const LoopLengths longest{tunnel_share * sizes.triangle,
                            max_of(tunnel_share * sizes.triangle, flat_share * sizes.longest),
                            a.as_in_the_paper() ? 0 : handle_share * sizes.triangle};
  // By thickness: a vertex, and how many of its loops cannot be cut.
  Stack<HeapEntry> waiting{open_scratch(a.w.context).tunnels(), a.w.context.limits.vertices, 0};
  ShortLoop loop;
  const auto find = [&](u32 v, u32 blocked) {
    ShortLoopSearch search = open_search(a.w);
    return blocked < most_loops_cut && find_short_loop(m, v, longest, blocked, search, loop);
  };
  const auto enter = [&](u32 v, u32 blocked) {
    if (find(v, blocked)) push_entry(waiting, {loop.thickness, v, blocked});
  };
  for (u32 v : a.w.edit.journal.claims.vertices)
    if (v < m.vertex_count && vertex_lives(m, v) && !is_old(m, v)) enter(v, 0);
  PinchOutcome last = PinchOutcome::done;
  while (left > 0 && last != PinchOutcome::dear && waiting.size > 0 && !has_stopped(a.meter())) {
    const HeapEntry next = pop_least(waiting);
    if (!find(next.number, next.tag)) continue;
    if (loop.thickness > next.weight) {
      push_entry(waiting, {loop.thickness, next.number, next.tag});
      continue;
    }
    if (const Outcome o = pinch_loop(a, loop, last); o != Outcome::clean) return o;
    const bool done = last == PinchOutcome::done;
    left -= done ? 1 : 0;
    enter(next.number, done ? 0 : next.tag + 1);
  }
  return has_stopped(a.meter()) ? Outcome::stopped : Outcome::clean;
}

}  // namespace

Outcome close_tunnels(Attempt& a, const CutSizes& sizes, i64 made) {
  if (made <= 0) return Outcome::clean;
  i64 left = made;
  const Outcome outcome = close_all(a, sizes, left);
  if (outcome == Outcome::clean && left < made) drop_specks(a, sizes);
  return outcome;
}

}  // namespace tpa
