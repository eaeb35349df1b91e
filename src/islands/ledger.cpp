// SPDX-License-Identifier: MIT
#include "islands/ledger.h"

#include <float.h>
#include <string.h>

#include "islands/rules.h"
#include "mesh/component_changes.h"
#include "mesh/component_volumes.h"
#include "mesh/winding_samples.h"

namespace tpa {

// ---------------------------------------------------------------- the bound

namespace {

// Certain to nearly all of its digits.
bool is_certain(const Component& c) { return c.volume.doubt <= 0x1p-20 * abs_of(c.volume.sum); }

}  // namespace

void know_volumes(Transaction& t) {
  Components& components = t.w.before;
  bool known = true;
  for (const Component& c : components.list) known = known && is_certain(c);
  if (known) return;
  spend(t.meter(), t.w.edit.mesh.face_count / 4);
  measure_before(t.w.edit, components);
}

Ledger open_ledger(const Transaction& t) {
  Workspace& w = t.w;
  const auto component_at = [&](u32 f) -> Component& {
    return w.before.list[component_of(w.before, w.edit.mesh.corner[3 * f])];
  };
  f64 volumes = 0;
  for (const Contact& c : w.detection.pairs)
    for_both(c, [&](u32 f) {
      Component& component = component_at(f);
      if (!component.is_followed) volumes += abs_of(component.volume.sum);
      component.is_followed = true;
    });
  for (const Contact& c : w.detection.pairs) for_both(c, [&](u32 f) { component_at(f).is_followed = false; });
  spend(t.meter(), w.detection.pairs.size);
  return {ledger_share * volumes};
}

// ---------------------------------------------------------------- the change

namespace {

bool lives_unchanged(const Edit& e, u32 f) {
  return f < e.journal.face_count && f < e.mesh.face_count && face_lives(e.mesh, f) && !is_changed(e, f);
}

// A face of the moved mesh that is gone or looks different now, or a face of the mesh that did so then.
struct SeenFace {
  const u32* vertex;
  Vec3 corner[3];
  u32 origin;
  bool is_now;
};

SeenFace seen_now(const Mesh& m, u32 f) {
  const u32* v = m.corner + 3 * static_cast<size_t>(f);
  return {v, {m.position[v[0]], m.position[v[1]], m.position[v[2]]}, m.face_origin[f], true};
}
SeenFace seen_then(const Workspace& w, u32 f) {
  const u32* v = old_corners(w.edit, f);
  return {v, {moved_position(w, v[0]), moved_position(w, v[1]), moved_position(w, v[2])}, f, false};
}

template <class Visit>
void visit_changed_faces(const Workspace& w, Visit visit) {
  const Edit& e = w.edit;
  for (u32 f : e.journal.claims.faces) {
    if (!is_changed(e, f)) continue;
    if (f < e.journal.face_count) visit(seen_then(w, f));
    if (f < e.mesh.face_count && face_lives(e.mesh, f)) visit(seen_now(e.mesh, f));
  }
}

// Has the vertex moved since?
bool has_left(const Workspace& w, u32 v) {
  return w.edit.journal.claims.vertices.contains(v) && !(moved_position(w, v) == w.edit.mesh.position[v]);
}

// Lists such old vertices in work_vertices.
void list_bent_vertices(Workspace& w) {
  const Mesh& m = w.edit.mesh;
  const u32 old = min_of(m.vertex_count, w.edit.journal.vertex_count);
  w.work_vertices.clear();
  for (u32 v : w.edit.journal.claims.vertices)
    if (v < old && has_left(w, v) && vertex_lives(m, v) && is_old(m, v)) w.work_vertices.push(v);
}

// Faces with listed vertices, each at its lowest vertex that has moved since.
template <class Visit>
void visit_bent_faces(const Workspace& w, Visit visit) {
  const Edit& e = w.edit;
  const Mesh& m = e.mesh;
  for (u32 v : w.work_vertices) {
    for_each_outgoing(m, v, [&](u32 h) {
      const u32 f = face_of(h);
      if (!lives_unchanged(e, f)) return;
      const SeenFace now = seen_now(m, f);
      for (u32 i = 0; i < 3; ++i)
        if (now.vertex[i] < v && has_left(w, now.vertex[i])) return;
      visit(seen_then(w, f));
      visit(now);
    });
  }
}

template <class Visit>
void visit_seen(const Workspace& w, Visit visit) {
  visit_changed_faces(w, visit);
  visit_bent_faces(w, visit);
}

struct Extent3 {
  Vec3 low = {largest_magnitude, largest_magnitude, largest_magnitude}, high = -1.0 * low;

  void add(const SeenFace& f) {
    for (const Vec3& p : f.corner) {
      low = {min_of(low.x, p.x), min_of(low.y, p.y), min_of(low.z, p.z)};
      high = {max_of(high.x, p.x), max_of(high.y, p.y), max_of(high.z, p.z)};
    }
  }
};

// Differences of winding numbers: from the moved mesh to the present one, and of the latter along lines of the grid.
struct Windings {
  i32 *differences, *now;
  u8 differs[SampleGrid::most_lines];  // lines on which any point differs
};

void find_lines_that_differ(const SampleGrid& g, Windings& s) {
  for (u32 line = 0; line < g.lines(); ++line) {
    i32 any = 0;
    for (u32 i = g.row * line; i < g.row * (line + 1); ++i) any |= s.differences[i];
    s.differs[line] = any != 0 ? 1 : 0;
  }
}

// Points of the region of the moved mesh, and of the present one, that the other region lacks.
struct Counts {
  u32 lost = 0, gained = 0;
};
void compare_regions(const SampleGrid& g, const Windings& s, i32 at_infinity, Counts& count) {
  for (u32 line = 0; line < g.lines(); ++line) {
    i32 difference = 0, now = at_infinity;
    for (u32 i = g.row * line; s.differs[line] != 0 && i < g.row * (line + 1); ++i) {
      difference += s.differences[i];
      now += s.now[i];
      const bool is_in = now > 0, was_in = now - difference > 0;
      count.lost += was_in && !is_in ? 1u : 0u;
      count.gained += is_in && !was_in ? 1u : 0u;
    }
  }
}

// The layers of the grid, and all before them along x.
Box shadow_of(const SampleGrid& g, const Extent3& extent) {
  Vec3 low = extent.low, high = extent.high;
  low.z = g.low.z + g.layer * g.cell.z;
  if (g.layer + g.layers() < g.side) high.z = low.z + g.layers() * g.cell.z;
  Box box = box_of(low, high, high);
  box.low[0] = -FLT_MAX;
  return box;
}

// How far the changed faces lie from the faces in contact, if farther than known.
f64 reach_of_faces(Transaction& t, f64 far) {
  visit_seen(t.w, [&](const SeenFace& f) {
    const u32 near = t.met.contains(f.origin) ? f.origin : none;
    if (near == none || f.is_now) far = t.met.reach_of(f.corner, 3, near, far);
  });
  return far;
}

void count_layers(const Transaction& t, const SampleGrid& grid, const Extent3& extent, Counts& count) {
  const Workspace& w = t.w;
  const Mesh& m = w.edit.mesh;
  const Scratch scratch = open_scratch(w.context);
  Windings s{scratch.winding_then(), scratch.winding_now(), {}};
  memset(s.differences, 0, grid.points() * sizeof(i32));
  memset(s.now, 0, grid.points() * sizeof(i32));
  u64 units = grid.points() / 8;
  visit_seen(w, [&](const SeenFace& f) {
    const Vec3 *const a = f.corner, *const b = a + (f.is_now ? 1 : 2), *const c = a + (f.is_now ? 2 : 1);
    units += add_crossings(grid, *a, *b, *c, s.differences);
  });
  find_lines_that_differ(grid, s);
  for_each_near(w.near_faces, shadow_of(grid, extent), [&](u32 f) {
    units += add_crossings(grid, corner_position(m, 3 * f), corner_position(m, 3 * f + 1),
                           corner_position(m, 3 * f + 2), s.now, s.differs);
  });
  spend(t.meter(), units);
  compare_regions(grid, s, t.winding_at_infinity(), count);
}

}  // namespace

RegionChange measure_change(Transaction& t, f64 bound) {
  list_bent_vertices(t.w);
  RegionChange change;
  change.met = &t.met;
  change.reach = t.region.reach;
  Extent3 extent;
  visit_seen(t.w, [&](const SeenFace& f) { extent.add(f); });
  constexpr u32 sides[] = {SampleGrid::coarse, SampleGrid::fine};
  f64 cell = 0;
  for (u32 side : sides) {
    SampleGrid grid = grid_between(extent.low, extent.high, side);
    cell = grid.six_volumes_of_cell();
    if (!(cell > 0)) return change;
    Counts count;
    do {
      count_layers(t, grid, extent, count);
    } while (grid.next());
    change.lost = grid.six_volumes_of_points(count.lost);
    change.gained = grid.six_volumes_of_points(count.gained);
    const u32 points = max_of(1u, count.lost + count.gained);
    if (abs_of(change.volume() - bound) > deviations * grid.deviation_of_points(points)) break;
  }
  // A cell hides that much between its points.
  if (cell > bound) change.lost += cell;
  // A change is bounded by changed faces.
  if (change.volume() > 0) change.add_bounded(change.volume(), [&](f64 so_far) { return reach_of_faces(t, so_far); });
  return change;
}

}  // namespace tpa
