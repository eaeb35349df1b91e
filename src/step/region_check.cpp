// SPDX-License-Identifier: MIT
#include "step/region_check.h"

#include <string.h>

#include "base/disjoint_sets.h"
#include "mesh/component_changes.h"
#include "mesh/winding_samples.h"

namespace tpa {

namespace {

bool lives_unchanged(const Edit& e, u32 f) {
  return f < e.journal.face_count && f < e.mesh.face_count && face_lives(e.mesh, f) && !is_changed(e, f);
}

// A face of the moved mesh that is gone or looks different now, or a face of the mesh that did so then.
struct SeenFace {
  const u32* vertex;
  Vec3 corner[3];
  bool is_now;
};

SeenFace seen_now(const Mesh& m, u32 f) {
  const u32* v = m.corner + 3 * static_cast<size_t>(f);
  return {v, {m.position[v[0]], m.position[v[1]], m.position[v[2]]}, true};
}
SeenFace seen_then(const Workspace& w, const u32* v) {
  return {v, {moved_position(w, v[0]), moved_position(w, v[1]), moved_position(w, v[2])}, false};
}

f64 squared_longest_edge(const SeenFace& f) {
  const Vec3 &a = f.corner[0], &b = f.corner[1], &c = f.corner[2];
  return max_of(squared_length(b - a), max_of(squared_length(c - b), squared_length(a - c)));
}

template <class Visit>
void visit_changed_faces(const Workspace& w, Visit visit) {
  const Edit& e = w.edit;
  for (u32 f : e.journal.faces) {
    if (!is_changed(e, f)) continue;
    if (f < e.journal.face_count) visit(seen_then(w, e.journal.face[f].corner));
    if (f < e.mesh.face_count && face_lives(e.mesh, f)) visit(seen_now(e.mesh, f));
  }
}

// Has the vertex moved since?
bool has_left(const Workspace& w, u32 v) {
  return w.edit.journal.vertices.contains(v) && !(moved_position(w, v) == w.edit.mesh.position[v]);
}

// Lists such old vertices in work_vertices.
void list_bent_vertices(Workspace& w) {
  const Mesh& m = w.edit.mesh;
  const u32 old = min_of(m.vertex_count, w.edit.journal.vertex_count);
  w.work_vertices.clear();
  for (u32 v : w.edit.journal.vertices)
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
      visit(seen_then(w, now.vertex));
      visit(now);
    });
  }
}

template <class Visit>
void visit_seen(const Workspace& w, Visit visit) {
  visit_changed_faces(w, visit);
  visit_bent_faces(w, visit);
}

// The volumes of the parts of a change, each at the lowest vertex of its part.
struct PartSums {
  u32* set;  // disjoint sets of vertices
  f64* volume;

  void begin(const SeenFace& f) const {
    for (u32 i = 0; i < 3; ++i) {
      set[f.vertex[i]] = f.vertex[i];
      volume[f.vertex[i]] = 0;
    }
  }
  f64& of(const SeenFace& f) const { return volume[find_set(set, f.vertex[0])]; }
  void join(u32 u, u32 v) const {
    const u32 a = find_set(set, u), b = find_set(set, v);
    if (a == b) return;
    join_sets(set, a, b);
    volume[min_of(a, b)] += volume[max_of(a, b)];
  }
};

// Volumes by connected parts of the change, so that a loss in one part does not hide a gain in another. The faces of a
// part, turned round where they are gone, are a closed surface: any eye gives its volume.
RegionChange change_by_parts(const Workspace& w) {
  const Scratch scratch = open_scratch(w.context);
  const PartSums parts{scratch.change_set(), scratch.change_volume()};
  f64 longest_gone = 0, longest_made = 0;  // squared
  u32 seen = 0;
  visit_changed_faces(w, [&](const SeenFace& f) {
    ++seen;
    parts.begin(f);
    f64& longest = f.is_now ? longest_made : longest_gone;
    longest = max_of(longest, squared_longest_edge(f));
  });
  visit_bent_faces(w, [&](const SeenFace& f) {
    ++seen;
    parts.begin(f);
  });
  spend(w.near_faces.meter, 4 * u64{seen});
  const Vec3 eye = w.edit.mesh.position[0];
  visit_seen(w, [&](const SeenFace& f) {
    parts.join(f.vertex[0], f.vertex[1]);
    parts.join(f.vertex[0], f.vertex[2]);
    const f64 cone = six_volumes_of(eye, f.corner[0], f.corner[1], f.corner[2]);
    parts.of(f) += f.is_now ? cone : -cone;
  });
  RegionChange change;
  visit_seen(w, [&](const SeenFace& f) {
    f64& sum = parts.of(f);
    change.add_volume(sum);
    sum = 0;
  });
  change.add_reach(square_root(longest_made) + 1.5 * square_root(longest_gone));
  return change;
}

SampleGrid grid_of_change(const Workspace& w) {
  Vec3 low = {largest_magnitude, largest_magnitude, largest_magnitude}, high = -1.0 * low;
  visit_seen(w, [&](const SeenFace& f) {
    for (const Vec3& p : f.corner) {
      low = {min_of(low.x, p.x), min_of(low.y, p.y), min_of(low.z, p.z)};
      high = {max_of(high.x, p.x), max_of(high.y, p.y), max_of(high.z, p.z)};
    }
  });
  return grid_between(low, high);
}

// The region of winding number 1 and more, then and now, at points all over the change: within a part, too, losses and
// gains may cancel, and where the moved surface overlaps itself no region is lost. Without result if the meter stops.
// O(V).
void sample_change(const Workspace& w, i32 at_infinity, RegionChange& change) {
  const Edit& e = w.edit;
  const Scratch scratch = open_scratch(w.context);
  i32 *const then = scratch.winding_then(), *const now = scratch.winding_now();
  memset(then, 0, SampleGrid::points * sizeof(i32));
  memset(now, 0, SampleGrid::points * sizeof(i32));
  const SampleGrid grid = grid_of_change(w);
  if (!(grid.six_volumes_of_cell() > 0)) return;
  Meter* meter = w.near_faces.meter;
  constexpr u32 between_spends = 256;  // faces
  u64 units = SampleGrid::points / 8;
  const auto enter = [&](const SeenFace& f, i32* to) {
    units += add_crossings(grid, f.corner[0], f.corner[1], f.corner[2], to);
  };
  const auto goes_on = [&](u32 f) {
    if (f % between_spends != 0) return true;
    spend(meter, units);
    units = 0;
    return !has_stopped(meter);
  };
  for (u32 f = 0; f < e.journal.face_count && goes_on(f); ++f)
    enter(seen_then(w, e.journal.faces.contains(f) ? e.journal.face[f].corner : e.mesh.corner + 3 * size_t{f}), then);
  for (u32 f = 0; f < e.mesh.face_count && goes_on(f); ++f) {
    ++units;
    if (face_lives(e.mesh, f)) enter(seen_now(e.mesh, f), now);
  }
  spend(meter, units);
  if (has_stopped(meter)) return;
  sum_crossings(at_infinity, then);
  sum_crossings(at_infinity, now);
  u32 lost = 0, gained = 0;
  for (u32 i = 0; i < SampleGrid::points; ++i) {
    lost += then[i] > 0 && now[i] <= 0 ? 1u : 0u;
    gained += then[i] <= 0 && now[i] > 0 ? 1u : 0u;
  }
  change.lost = lost * grid.six_volumes_of_cell();
  change.gained = gained * grid.six_volumes_of_cell();
}

// Sums of(f) over the living faces.
template <class Of>
f64 sum_over_faces(const Mesh& m, const Exec& exec, Of of) {
  return sum_of_chunks(exec, m.face_count, [&](u32 first, u32 last) {
    f64 sum = 0;
    for (u32 f = first; f < last; ++f)
      if (face_lives(m, f)) sum += of(f);
    return sum;
  });
}

}  // namespace

f64 six_volumes(const Mesh& m, const Exec& exec) {
  const Vec3 from = m.position[0];
  return abs_of(sum_over_faces(m, exec, [&](u32 f) {
    return six_volumes_of(from, corner_position(m, 3 * f), corner_position(m, 3 * f + 1),
                          corner_position(m, 3 * f + 2));
  }));
}

namespace {

f64 area_of(const Vec3 (&corner)[3]) { return 0.5 * length(area_normal(corner[0], corner[1], corner[2])); }

// The mean area of the faces that the transaction has replaced, in the moved mesh, weighted by area.
f64 mean_area_gone(const Workspace& w) {
  f64 sum = 0, squares = 0;
  visit_changed_faces(w, [&](const SeenFace& f) {
    const f64 area = f.is_now ? 0 : area_of(f.corner);
    sum += area;
    squares += area * area;
  });
  return sum > 0 ? squares / sum : 0;
}

f64 mean_area(const Mesh& m, const Exec& exec) {
  u32 count = m.face_count;
  for (u32 f = m.free_face; f != none; f = m.corner[3 * f + 1]) --count;
  const f64 sum = sum_over_faces(m, exec, [&](u32 f) { return 0.5 * length(face_normal(m, f)); });
  return count > 0 ? sum / count : 0;
}

// The largest change as a share of all bodies. For larger triangles than those of even meshes it falls with the volume
// that their edges span.
f64 largest_share(const Workspace& w, const Exec& exec) {
  const f64 gone = mean_area_gone(w), usual = even_factor * mean_area(w.edit.mesh, exec);
  if (gone <= usual) return small_share;
  const f64 ratio = usual / gone;
  return max_of(least_share, small_share * ratio * square_root(ratio));
}

}  // namespace

bool is_small_change(Attempt& a, RegionChange& change) {
  list_bent_vertices(a.w);
  change = change_by_parts(a.w);
  const f64 local = 6 * small_change * a.room;
  if (change.volume() > local) return false;
  if (a.moves_few()) return true;
  const f64 all = a.six_volumes_of_bodies = six_volumes(a.w.edit.mesh, a.t.exec);
  if (local <= least_share * all) return true;
  const f64 most = largest_share(a.w, a.t.exec) * all;
  if (change.volume() > most) return false;
  if (local <= most) return true;
  sample_change(a.w, a.winding_at_infinity(), change);
  return change.lost <= most && change.gained <= 2 * most;
}

}  // namespace tpa
