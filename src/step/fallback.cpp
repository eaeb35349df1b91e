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

}  // namespace

void give_way_at_contacts(Attempt& a) {
  for (const Contact& c : a.w.detection.pairs)
    for (u32 i = 0; i < 3; ++i) {
      freeze(a, a.w.edit.mesh.corner[3 * c.a + i]);
      freeze(a, a.w.edit.mesh.corner[3 * c.b + i]);
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
