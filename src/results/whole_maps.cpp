// SPDX-License-Identifier: MIT
#include "results/whole_maps.h"

#include <string.h>

#include "block/way_back.h"
#include "results/true_origins.h"

namespace tpa {

namespace {

// An array for each map, in ids before the first commit.
struct WholeMaps {
  VertexOrigin* origin;  // per present vertex
  u32* old_to_new;       // per vertex before
  u32* face_origin;      // per present face
};

WholeMaps whole_maps(const Context& c) {
  return {table_data<VertexOrigin>(c, table_whole_origin), table_data<u32>(c, table_whole_map),
          table_data<u32>(c, table_whole_face_origin)};
}

// An origin in ids before the first commit, from an origin in ids before the last.
VertexOrigin through(const Mesh& before, const VertexOrigin& o) {
  if (o.parents[1] == none) return before.vertex_origin[o.parents[0]];
  return blend_origins(before, o.parents[0], o.parents[1], 1 - f64{o.weight});
}

void make_identity(Workspace& w) {
  const Mesh& m = w.edit.mesh;
  Context& c = w.context;
  for (u32 v = 0; v < m.vertex_count; ++v) m.vertex_origin[v] = {{v, none}, 1.0f};
  for (u32 f = 0; f < m.face_count; ++f) m.face_origin[f] = f;
  for (u32 v = 0; v < max_of(m.vertex_count, c.old_vertex_count); ++v) w.old_to_new[v] = v;
  c.old_vertex_count = m.vertex_count;
  c.old_face_count = m.face_count;
  w.edit.journal.vertices.clear();
  w.edit.journal.faces.clear();
}

// Where the move alone took the vertices before the first commit: to their targets; vertices left behind, to where they
// are. The goals are not needed any more.
const Vec3* places_of_first(const Workspace& w) {
  const Context& c = w.context;
  Vec3* place = table_data<Vec3>(c, table_goal);
  const Vec3 *position = kept_positions(c), *target = kept_targets(c);
  const BitSet with_target = kept_vertices_with_target(c);
  for (u32 u = 0; u < c.old_vertex_count; ++u) {
    const u32 v = w.old_to_new[u];
    const bool left = v != none && w.rolled_back.contains(v);
    place[u] = left ? w.edit.mesh.position[v] : with_target.contains(u) ? target[u] : position[u];
  }
  return place;
}

}  // namespace

void begin_whole_maps(Context& c) {
  const WholeMaps whole = whole_maps(c);
  for (u32 v = 0; v < c.vertex_count; ++v) {
    whole.origin[v] = {{v, none}, 1.0f};
    whole.old_to_new[v] = v;
  }
  for (u32 f = 0; f < c.face_count; ++f) whole.face_origin[f] = f;
}

void add_to_whole_maps(Workspace& w) {
  const Mesh& m = w.edit.mesh;
  const WholeMaps whole = whole_maps(w.context);
  Mesh before = m;
  before.vertex_origin = whole.origin;
  for (u32 v = 0; v < m.vertex_count; ++v) m.vertex_origin[v] = through(before, m.vertex_origin[v]);
  memcpy(whole.origin, m.vertex_origin, m.vertex_count * sizeof *m.vertex_origin);
  for (u32 f = 0; f < m.face_count; ++f)
    if (m.face_origin[f] != none) m.face_origin[f] = whole.face_origin[m.face_origin[f]];
  memcpy(whole.face_origin, m.face_origin, m.face_count * sizeof *m.face_origin);
  for (u32 u = 0; u < kept_context(w.context).vertex_count; ++u)
    if (whole.old_to_new[u] != none) whole.old_to_new[u] = w.old_to_new[whole.old_to_new[u]];
  make_identity(w);
}

void publish_whole_maps(Workspace& w) {
  const Mesh& m = w.edit.mesh;
  Context& c = w.context;
  const WholeMaps whole = whole_maps(c);
  c.old_vertex_count = kept_context(c).vertex_count;
  c.old_face_count = kept_context(c).face_count;
  memcpy(m.vertex_origin, whole.origin, m.vertex_count * sizeof *m.vertex_origin);
  memcpy(m.face_origin, whole.face_origin, m.face_count * sizeof *m.face_origin);
  memcpy(w.old_to_new, whole.old_to_new, c.old_vertex_count * sizeof(u32));
  find_true_origins_from(w, places_of_first(w));
  note_mapped(w.edit, w.old_to_new);
  const Vec3* position = kept_positions(c);
  const u32* corner = kept_corners(c);
  BitSet vertices = open_changed_vertices(c), faces = open_changed_faces(c);
  vertices.clear();
  faces.clear();
  for (u32 v = 0; v < m.vertex_count; ++v)
    if (v >= c.old_vertex_count || !have_same_bits(position[v], m.position[v])) vertices.add(v);
  for (u32 f = 0; f < m.face_count; ++f)
    if (f >= c.old_face_count || memcmp(corner + 3 * f, m.corner + 3 * f, 3 * sizeof(u32)) != 0) faces.add(f);
  c.all_changed = false;
}

}  // namespace tpa
