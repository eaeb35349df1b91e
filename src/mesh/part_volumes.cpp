// SPDX-License-Identifier: MIT
#include "mesh/part_volumes.h"

#include "mesh/component_volumes.h"

namespace tpa {

namespace {

struct PartVolumes {
  const Edit& e;
  Components& before;
  Parts& p;

  // The family of a component before; nullptr if only positions changed.
  Family* family_of(u32 component) const {
    if (before.list[component].family == none) return nullptr;
    return &p.families[p.place[find_family(before, component)]];
  }
  Family* family_of_vertex(u32 v) const { return family_of(component_of(before, e.mesh.vertex_origin[v].parents[0])); }
};

// The point of view of a family: a vertex before. Closed surfaces enclose the same from any point.
const Vec3& eye_of(const Edit& e, const Family& f) { return old_position(e, f.before); }

// The volume and size of each family before. Unknown volumes stay unknown, whatever is added.
void add_components(PartVolumes& q) {
  for (u32 i : q.p.touched) {
    const Component& component = q.before.list[i];
    Family& f = *q.family_of(i);
    add(f.volume, component.volume);
    f.size += component.size + size_of(old_position(q.e, component.id) - eye_of(q.e, f));
  }
}

// Subtracts changed faces as before, and adds them as now, both times with old positions: all other faces are unchanged
// so far.
void add_changed_faces(PartVolumes& q) {
  const Edit& e = q.e;
  const Mesh& m = e.mesh;
  const Journal& j = e.journal;
  const auto old = [&](u32 v) -> const Vec3& { return old_position(e, v); };
  const auto before = [&](u32 v) -> const Vec3& { return v < j.vertex_count ? old_position(e, v) : m.position[v]; };
  for (u32 f : j.faces) {
    if (!is_changed(e, f)) continue;
    if (f < j.face_count) {
      const u32* c = j.face[f].corner;
      Family& family = *q.family_of(component_of(q.before, c[0]));
      add(family.volume, -1, eye_of(e, family), old(c[0]), old(c[1]), old(c[2]));
    }
    if (f < m.face_count && face_lives(m, f)) {
      const u32* c = m.corner + 3 * f;
      Family& family = *q.family_of_vertex(c[0]);
      add(family.volume, 1, eye_of(e, family), before(c[0]), before(c[1]), before(c[2]));
    }
  }
}

// After the faces, vertices move from old to new positions, one after another.
void add_moves(PartVolumes& q) {
  const Edit& e = q.e;
  const Mesh& m = e.mesh;
  f64 farthest = 0;  // from the old position of a vertex or parent
  for (u32 v : e.journal.vertices) {
    if (v >= m.vertex_count || !vertex_lives(m, v)) continue;
    farthest = max_of(farthest, size_of(m.position[v] - old_position(e, m.vertex_origin[v].parents[0])));
    if (v >= e.journal.vertex_count || !has_moved(e, v)) continue;
    if (Family* family = q.family_of_vertex(v)) add(family->volume, change_by_move(e, v));
  }
  for (Family& f : q.p.families) f.size += 2 * farthest;
}

// Measures a part with all vertices known, and subtracts the volume from the family.
void measure_whole(PartVolumes& q, Part& part, Family& f) {
  const Mesh& m = q.e.mesh;
  const Vec3& from = m.position[part.done.first];
  part.volume = {};
  part.size = 0;
  for_each_vertex(q.p, part, [&](u32 v) {
    part.size = max_of(part.size, 2 * size_of(m.position[v] - from));
    add_faces_above(part.volume, m, from, v);
  });
  add(f.volume, {-part.volume.sum, part.volume.doubt});
}

}  // namespace

void measure_parts(const Edit& e, Components& before, Parts& p) {
  PartVolumes q{e, before, p};
  add_components(q);
  add_changed_faces(q);
  add_moves(q);
  for (Part& part : p.list)
    if (is_root(p, part) && part.is_whole) measure_whole(q, part, p.families[part.family]);
  for (const Family& f : p.families) {
    if (f.open_part == none) continue;
    Part& part = p.list[f.open_part];
    part.volume = {f.volume.sum, min_of(f.volume.doubt, unknown_volume)};
    part.size = f.size;
  }
}

}  // namespace tpa
