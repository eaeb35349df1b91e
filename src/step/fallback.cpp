// SPDX-License-Identifier: MIT
#include "step/fallback.h"

namespace tpa {

namespace {

void freeze(Attempt& a, u32 v) {
  const VertexOrigin& o = a.w.edit.mesh.vertex_origin[v];
  for (u32 parent : o.parents)
    if (parent != none && state_of(a.w, parent, frozen_state) == free_vertex)
      set_state(a.w, parent, frozen_state, newly_frozen);
}

void take_along(Attempt& a, u32 v) {
  for (u32 parent : a.w.edit.mesh.vertex_origin[v].parents)
    if (parent != none) set_state(a.w, parent, next_time_state, taken_along);
}

// Marks all old vertices of a group, and the old parents of its new vertices, unless `state` holds a mark already.
void mark_group(Attempt& a, u32 group, u8 state, u8 how) {
  const Clusters& r = a.w.clusters;
  const Mesh& m = a.w.edit.mesh;
  for (u32 v : r.members) r.gives_way[v] = 0;
  for (const CutLoop& loop : r.loops)
    if (loop.group == group) r.gives_way[loop.cluster] = 1;
  for (u32 v : r.members) {
    if (r.gives_way[find_cluster(r, v)] == 0) continue;
    // A removed vertex still knows its second parent.
    const u32 old = is_old(m, v) ? v : m.vertex_origin[v].parents[1];
    if (state_of(a.w, old, state) == 0) set_state(a.w, old, state, how);
  }
}

}  // namespace

void give_way(Attempt& a, const Piece& piece, Span<const u32> open) {
  const Clusters& r = a.w.clusters;
  // After halved faces, or after the paper's way, the next attempt differs without further marks.
  const bool will_differ = a.is_first() && (a.halved || a.as_in_the_paper());
  if (a.is_first() && a.halved) mark_group(a, r.loops[piece.first_loop].group, next_time_state, left_coarse);
  if (will_differ) return;
  if (!a.may_cap() && !open.empty()) {
    for (u32 v : open) take_along(a, v);
    return;
  }
  if (a.may_cap()) mark_group(a, r.loops[piece.first_loop].group, frozen_state, newly_frozen);
  for (u32 i = 0; i < piece.loops; ++i) {
    const CutLoop& loop = r.loops[piece.first_loop + i];
    for (u32 k = 0; k < loop.count; ++k) {
      const u32 v = r.cuts[loop.first + k].vertex;
      if (a.may_cap())
        freeze(a, v);
      else
        take_along(a, v);
    }
  }
}

void give_way_at_contacts(Attempt& a) {
  const auto mark = [&](u32 v) {
    if (a.is_step())
      freeze(a, v);
    else
      take_along(a, v);
  };
  for (const Contact& c : a.w.detection.pairs)
    for (u32 i = 0; i < 3; ++i) {
      mark(a.w.edit.mesh.corner[3 * c.a + i]);
      mark(a.w.edit.mesh.corner[3 * c.b + i]);
    }
}

void grow_frozen(Workspace& w, u32 rings) {
  const Mesh& m = w.edit.mesh;
  if (rings == whole_mesh) {
    for (u32 v = 0; v < m.vertex_count; ++v) set_state(w, v, frozen_state, frozen_vertex);
    return;
  }
  Stack<u32>& front = w.work_vertices;
  front.clear();
  for (u32 v = 0; v < m.vertex_count; ++v)
    if (state_of(w, v, frozen_state) == newly_frozen) {
      set_state(w, v, frozen_state, frozen_vertex);
      front.push(v);
    }
  u32 begin = 0;
  for (u32 ring = 0; ring < rings; ++ring) {
    const u32 end = front.size;
    for (; begin < end; ++begin)
      for_each_neighbour(m, front[begin], [&](u32 u) {
        if (state_of(w, u, frozen_state) == frozen_vertex) return;
        set_state(w, u, frozen_state, frozen_vertex);
        front.push(u);
      });
  }
}

}  // namespace tpa
