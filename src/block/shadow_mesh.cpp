// SPDX-License-Identifier: MIT
#include "block/shadow_mesh.h"

#include <string.h>

#include "mesh/validate.h"

namespace tpa {

Mesh open_shadow_mesh(const Context& c, u32 vertices, u32 faces) {
  Mesh m;
  m.position = table_data<Vec3>(c, table_journal_position);
  m.vertex_edge = table_data<u32>(c, table_journal_vertex);
  m.corner = table_data<u32>(c, table_journal_face);
  m.opposite = open_scratch(c).loaded_opposite();
  m.vertex_capacity = c.limits.vertices;
  m.face_capacity = c.limits.triangles;
  m.vertex_count = vertices;
  m.face_count = faces;
  return m;
}

Defect check_shadow_mesh(Context& c, Mesh& shadow) {
  Defect d = check_positions(shadow.position, shadow.vertex_count);
  if (d.kind == 0) d = check_indices(shadow.corner, shadow.face_count, shadow.vertex_count);
  if (d.kind != 0) return d;
  c.components_known = c.near_faces_stand = false;
  return connect(shadow, table_data<u32>(c, table_component_label), open_scratch(c).sorted_edges());
}

u32 label_shadow_mesh(Context& c, const Mesh& shadow) {
  Workspace w = open(c);
  return find_components(shadow, w.before, w.work_vertices.data);
}

void drop_shadow_mesh(Context& c) {
  Workspace w = open(c);
  close(w);
}

void adopt_shadow_mesh(Context& c, const Mesh& s, u32 components) {
  forget_all(c);
  const Mesh m = open(c).edit.mesh;
  memcpy(m.position, s.position, s.vertex_count * sizeof(Vec3));
  memcpy(m.vertex_edge, s.vertex_edge, s.vertex_count * sizeof(u32));
  memcpy(m.corner, s.corner, s.face_count * 3 * sizeof(u32));
  memcpy(m.opposite, s.opposite, s.face_count * 3 * sizeof(u32));
  u32* old_to_new = table_data<u32>(c, table_old_to_new);
  for (u32 v = 0; v < s.vertex_count; ++v) {
    m.vertex_origin[v] = {{v, none}, 1.0f};
    old_to_new[v] = v;
  }
  for (u32 f = 0; f < s.face_count; ++f) m.face_origin[f] = f;
  c.vertex_count = c.old_vertex_count = s.vertex_count;
  c.face_count = c.old_face_count = s.face_count;
  c.loaded = c.all_changed = true;
  c.component_count = c.component_nodes = components;
  c.components_known = true;
  if (c.config.detect_mode == TPA_DETECT_VERTEX_HASH) note_longest_edge(c, s);
  note_peak(c, Measure::vertices, s.vertex_count);
  note_peak(c, Measure::triangles, s.face_count);
  note_peak(c, Measure::components, components);
}

}  // namespace tpa
