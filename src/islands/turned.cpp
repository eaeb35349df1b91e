// SPDX-License-Identifier: MIT
#include "islands/turned.h"

#include <string.h>

#include "islands/rules.h"
#include "islands/small_components.h"
#include "mesh/winding_samples.h"

namespace tpa {

namespace {

// Has the move turned a component inside out? `before` becomes its volume before.
bool is_turned(const Edit& e, Span<const u32> vertices, SignedVolume& before) {
  const Vec3 *const p = e.mesh.position, eye = p[vertices[0]], old_eye = old_position(e, vertices[0]);
  SignedVolume now;
  for_each_face_of(e.mesh, vertices, [&](u32 h) {
    const u32 a = tail(e.mesh, h), b = head(e.mesh, h), c = apex(e.mesh, h);
    add(before, 1, old_eye, old_position(e, a), old_position(e, b), old_position(e, c));
    add(now, 1, eye, p[a], p[b], p[c]);
  });
  return abs_of(before.sum) > before.doubt && abs_of(now.sum) > now.doubt && (before.sum < 0) != (now.sum < 0);
}

// How far the faces of a component, all of them old, lie from the faces in contact, if farther than known.
f64 reach_of_folds(FacesInContact& met, const Mesh& m, Span<const u32> vertices, f64 far) {
  for_each_face_of(m, vertices, [&](u32 h) {
    const Vec3 corner[] = {m.position[tail(m, h)], m.position[head(m, h)], m.position[apex(m, h)]};
    far = met.reach_of(corner, 3, none, far);
  });
  return far;
}

// The change of the region if a component goes.
RegionChange measure_crumbs(Transaction& t, Span<const u32> vertices, bool was_void) {
  const Workspace& w = t.w;
  const Mesh& m = w.edit.mesh;
  Vec3 low = m.position[vertices[0]], high = low;
  for (u32 v : vertices) {
    const Vec3& p = m.position[v];
    low = {min_of(low.x, p.x), min_of(low.y, p.y), min_of(low.z, p.z)};
    high = {max_of(high.x, p.x), max_of(high.y, p.y), max_of(high.z, p.z)};
  }
  SampleGrid grid = grid_between(low, high, SampleGrid::fine);
  i32* const winding = open_scratch(w.context).winding_now();
  f64 crumbs = 0;
  do {
    memset(winding, 0, grid.points() * sizeof *winding);
    u64 units = grid.points() / 8;
    for_each_face_of(m, vertices, [&](u32 h) {
      units += add_crossings(grid, m.position[tail(m, h)], m.position[head(m, h)], m.position[apex(m, h)], winding);
    });
    spend(w.near_faces.meter, units);
    sum_crossings(grid, was_void ? 1 : 0, winding);
    for (u32 i = 0; i < grid.points(); ++i) crumbs += (winding[i] > 0) != was_void ? 1 : 0;
  } while (grid.next());
  RegionChange change;
  change.add_volume((was_void ? 1 : -1) * grid.six_volumes_of_points(crumbs));
  change.reach = t.region.reach;
  if (crumbs > 0)
    change.add_bounded(change.volume(), [&](f64 so_far) { return reach_of_folds(t.met, m, vertices, so_far); });
  return change;
}

// Six times a volume: layers on all faces of a component, as thick as the mean width of the faces.
f64 volume_of_folds(const Mesh& m, Span<const u32> vertices) {
  f64 widths = 0, area = 0;
  u32 faces = 0;
  for_each_face_of(m, vertices, [&](u32 h) {
    const f64 twice = length(face_normal(m, face_of(h)));
    widths += square_root(twice);
    area += 0.5 * twice;
    ++faces;
  });
  return 6 * widths / faces * area;
}

// Removes the component at a vertex, if it is turned.
bool drop_if_turned(Attempt& a, u32 v) {
  Workspace& w = a.w;
  Stack<u32>& found = w.work_vertices;
  const u32 begin = found.size;
  if (!collect_small_component(w, v, w.detection.pairs.size)) return false;
  const Span<const u32> vertices = found.span().part(begin, found.size - begin);
  SignedVolume before;
  if (!is_turned(w.edit, vertices, before)) return false;
  const RegionChange change = measure_crumbs(a.t, vertices, before.sum < 0);
  const f64 most = min_of(crumbs_share * abs_of(before.sum), layer_share * volume_of_folds(w.edit.mesh, vertices));
  if (change.volume() > max_of(a.left_in_ledger(), most)) return false;
  a.region.add(change);
  // Crumbs are no part of the body any more, so the ledger is not asked.
  a.ledger.bound += change.volume();
  ++a.t.report.removed_patches;
  add_event(a.t, TPA_EVENT_REMOVAL, vertices.size, TPA_NONE, TPA_NONE, w.edit.mesh.position[v]);
  remove_component(w.edit, w.near_faces, vertices);
  return true;
}

// Forgets contacts of faces that are gone.
void keep_living(const Mesh& m, Detection& d) {
  u32 left = 0;
  for (const Contact& c : d.pairs)
    if (face_lives(m, c.a)) d.pairs[left++] = c;
  d.found -= d.pairs.size - left;
  d.pairs.size = left;
}

}  // namespace

void drop_turned(Attempt& a) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  Components& components = w.before;
  const auto component_at = [&](u32 f) -> Component& {
    return components.list[component_of(components, m.corner[3 * f])];
  };
  spend(a.meter(), 2 * u64{w.detection.pairs.size} + components.list.size);
  for (Component& c : components.list) c.verdict = Verdict::unknown;
  for (const Contact& c : w.detection.pairs)
    if (&component_at(c.a) != &component_at(c.b))
      component_at(c.a).verdict = component_at(c.b).verdict = Verdict::stays;
  w.work_vertices.clear();
  bool any = false;
  for (const Contact& c : w.detection.pairs) {
    if (!face_lives(m, c.a) || component_at(c.a).verdict != Verdict::unknown || has_stopped(a.meter())) continue;
    component_at(c.a).verdict = Verdict::stays;
    any = drop_if_turned(a, m.corner[3 * c.a]) || any;
  }
  for (u32 v : w.work_vertices) w.relocation.vertex_mark[v] = 0;
  if (any) keep_living(m, w.detection);
}

}  // namespace tpa
