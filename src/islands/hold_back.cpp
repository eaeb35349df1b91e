// SPDX-License-Identifier: MIT
#include "islands/hold_back.h"

namespace tpa {

namespace {

// A vertex held back before is passed again, so that rings are counted from the contacts.
void choose(Workspace& w, u32 v) {
  if (state_of(w, v, frozen_state) == newly_frozen) return;
  set_state(w, v, frozen_state, newly_frozen);
  w.work_vertices.push(v);
}

// Back to the old position, as an edit of the island.
void put_back(Transaction& t, u32 v) {
  Workspace& w = t.w;
  if (state_of(w, v, target_state) != target_taken) return;
  set_state(w, v, target_state, target_refused);
  set_position(w.edit, v, old_position(w.edit, v));
  t.held_back.add(v);
  --t.moved;
  ++t.refused;
  for_each_outgoing(w.edit.mesh, v, [&](u32 h) {
    touch_face(w.edit, face_of(h));
    insert(w.near_faces, w.edit.mesh, face_of(h));
  });
}

}  // namespace

void choose_at_contacts(Attempt& a) {
  const Mesh& m = a.w.edit.mesh;
  a.w.work_vertices.clear();
  for (const Contact& c : a.w.detection.pairs)
    for_both(c, [&](u32 f) {
      for (u32 h = 3 * f; h < 3 * f + 3; ++h)
        for (u32 parent : m.vertex_origin[m.corner[h]].parents)
          if (parent != none) choose(a.w, parent);
    });
}

void choose_at_faces(Transaction& t, Span<const IslandContact> contacts) {
  for (const IslandContact& c : contacts)
    for_both(c, [&](u32 f) {
      for (u32 h = 3 * f; h < 3 * f + 3; ++h) choose(t.w, t.w.edit.mesh.corner[h]);
    });
}

u32 hold_back(Transaction& t, u32 rings) {
  Workspace& w = t.w;
  const u32 before = t.refused;
  Stack<u32>& front = w.work_vertices;
  u32 begin = 0;
  for (u32 ring = 0; ring < rings && begin < front.size; ++ring)
    for (const u32 end = front.size; begin < end; ++begin)
      for_each_neighbour(w.edit.mesh, front[begin], [&](u32 u) { choose(w, u); });
  for (u32 v : front) {
    set_state(w, v, frozen_state, frozen_vertex);
    put_back(t, v);
  }
  spend(t.meter(), 16 * u64{front.size});
  return t.refused - before;
}

}  // namespace tpa
