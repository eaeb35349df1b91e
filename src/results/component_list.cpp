// SPDX-License-Identifier: MIT
#include "results/component_list.h"

namespace tpa {

namespace {

void begin_list(const Context& c, const Components& known, tpa_component* list) {
  const bool changed = c.ancestor_count > 0;
  const u32* before = table_data<u32>(c, table_component_before);
  for (u32 i = 0; i < known.list.size; ++i) {
    const Component& component = known.list.data[i];
    list[i] = {};
    list[i].id = component.id;
    list[i].before = changed ? before[i] : component.id;
    list[i].genus = genus_of(component.euler);
  }
}

void take_vertices(const Context& c, const Components& known, tpa_component* list) {
  const Vec3* position = table_data<Vec3>(c, table_position);
  for (u32 v = 0; v < c.vertex_count; ++v) {
    tpa_component& here = list[place_of(known, v)];
    const bool first = here.vertices++ == 0;
    for (i32 k = 0; k < 3; ++k) {
      const f64 x = position[v][k];
      f64 &low = here.box[k], &high = here.box[3 + k];
      low = first ? x : min_of(low, x);
      high = first ? x : max_of(high, x);
    }
  }
}

// Each component is seen from one of its vertices: far from the origin few digits would be left.
void take_faces(const Context& c, const Components& known, tpa_component* list) {
  const Vec3* position = table_data<Vec3>(c, table_position);
  const u32* corner = table_data<u32>(c, table_corner);
  for (u32 f = 0; f < c.face_count; ++f) {
    const u32* v = corner + 3 * static_cast<size_t>(f);
    const Vec3 &p = position[v[0]], &q = position[v[1]], &r = position[v[2]];
    tpa_component& here = list[place_of(known, v[0])];
    ++here.triangles;
    here.volume += six_volumes_of(position[here.id], p, q, r);
    here.area += length(area_normal(p, q, r));
  }
}

}  // namespace

void list_components(const Context& c, const Components& known, tpa_component* list) {
  begin_list(c, known, list);
  take_vertices(c, known, list);
  take_faces(c, known, list);
  for (u32 i = 0; i < known.list.size; ++i) {
    list[i].volume /= 6;
    list[i].area /= 2;
  }
}

}  // namespace tpa
