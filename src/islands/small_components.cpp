// SPDX-License-Identifier: MIT
#include "islands/small_components.h"

namespace tpa {

bool collect_small_component(Workspace& w, u32 v, u32 most) {
  const Mesh& m = w.edit.mesh;
  Stack<u32>& found = w.work_vertices;
  u8* mark = w.relocation.vertex_mark;
  const u32 begin = found.size;
  bool small = true;
  const auto reach = [&](u32 u) {
    if (mark[u] == 0) {
      mark[u] = found_now;
      found.push(u);
    }
    small = mark[u] != found_before && found.size - begin <= most;
    return small;
  };
  reach(v);
  for (u32 i = begin; i < found.size && small; ++i) {
    const u32 first = m.vertex_edge[found[i]];
    u32 h = first;
    while (reach(head(m, h)) && (h = rotate(m, h)) != first) {
    }
  }
  for (u32 u : found.span().part(begin, found.size - begin)) mark[u] = found_before;
  spend(w.near_faces.meter, 4 * u64{found.size - begin});
  return small;
}

void remove_component(Edit& e, NearFaces& near, Span<const u32> vertices) {
  for (u32 v : vertices)
    for_each_outgoing(e.mesh, v, [&](u32 h) {
      if (!face_lives(e.mesh, face_of(h))) return;
      remove(near, face_of(h));
      delete_face(e, face_of(h));
    });
  for (u32 v : vertices) delete_vertex(e, v);
}

}  // namespace tpa
