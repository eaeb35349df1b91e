// SPDX-License-Identifier: MIT
#include "step/tidy_cut.h"

#include "edit/collapse.h"
#include "step/region_check.h"

namespace tpa {

namespace {

bool is_new(const Edit& e, u32 v) { return v < e.mesh.vertex_count && vertex_lives(e.mesh, v) && !is_old(e.mesh, v); }

// The nearest neighbour of v, the lower of equally near ones.
u32 nearest_neighbour(const Mesh& m, u32 v, f64& squared_distance, Meter* meter) {
  u32 nearest = none, neighbours = 0;
  squared_distance = no_way;
  for_each_neighbour(m, v, [&](u32 u) {
    const f64 d = squared_length(m.position[u] - m.position[v]);
    ++neighbours;
    if (d < squared_distance || (d == squared_distance && u < nearest)) squared_distance = d, nearest = u;
  });
  spend(meter, neighbours / 2);
  return nearest;
}

// Merges a new vertex with its neighbours, the nearest first, or such a neighbour with it. Old vertices keep their
// places. False if nothing was done.
bool merge_with_neighbour(Attempt& a, u32 v, f64 closest, f64 allowed) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  f64 squared = 0;
  const u32 u = nearest_neighbour(m, v, squared, a.meter());
  if (u == none || !(squared < closest * closest)) return false;
  const auto merge = [&](u32 goes, u32 stays) {
    RegionChange change = a.region;
    change.add_move(m, goes, m.position[goes], m.position[stays]);
    if (change.volume() > allowed || !collapse(w.edit, w.near_faces, goes, stays, m.position[stays],
                                               m.vertex_origin[stays], Expected::bent, w.relocation.face_mark))
      return false;
    a.region = change;
    return true;
  };
  return merge(v, u) || (!is_old(m, u) && merge(u, v));
}

void merge_new_vertices(Attempt& a, f64 closest, f64 allowed) {
  Workspace& w = a.w;
  constexpr u32 most_rounds = 8;
  for (u32 round = 0, merged = 1; merged > 0 && round < most_rounds; ++round) {
    merged = 0;
    for (u32 v : w.edit.journal.vertices) {
      if (has_stopped(a.meter())) return;
      if (is_new(w.edit, v) && merge_with_neighbour(a, v, closest, allowed)) ++merged;
    }
  }
}

}  // namespace

f64 spacing_of_contacts(const Workspace& w) {
  const Mesh& m = w.edit.mesh;
  f64 sum = 0;
  u64 count = 0;
  const auto add = [&](u32 f) {
    f64 shortest = no_way;
    for (u32 h = 3 * f; h < 3 * f + 3; ++h)
      shortest = min_of(shortest, squared_length(m.position[head(m, h)] - m.position[tail(m, h)]));
    sum += square_root(shortest);
    ++count;
  };
  for (const Contact& c : w.detection.pairs) {
    add(c.a);
    add(c.b);
  }
  return count == 0 ? 0 : sum / static_cast<f64>(count);
}

namespace {

// Lists the component of v in w.work_vertices, up to `most` vertices. False if it has more.
bool collect_small_component(Workspace& w, u32 v, u32 most) {
  const Mesh& m = w.edit.mesh;
  Stack<u32>& found = w.work_vertices;
  u8* mark = w.relocation.vertex_mark;
  found.clear();
  const auto reach = [&](u32 u) {
    if (mark[u] != 0) return;
    mark[u] = 1;
    found.push(u);
  };
  reach(v);
  for (u32 i = 0; i < found.size && found.size <= most; ++i) {
    const u32 first = m.vertex_edge[found[i]];
    u32 h = first;
    do {
      reach(head(m, h));
      h = rotate(m, h);
    } while (h != first && found.size <= most);
  }
  for (u32 u : found) mark[u] = 0;
  spend(w.near_faces.meter, 4 * u64{found.size});
  return found.size <= most;
}

// The volume of the component in w.work_vertices, times six.
f64 six_volumes_of_component(const Workspace& w) {
  const Mesh& m = w.edit.mesh;
  const Vec3& from = m.position[w.work_vertices[0]];
  f64 sum = 0;
  for (u32 v : w.work_vertices)
    for_each_outgoing(m, v, [&](u32 h) {
      if (v < head(m, h) && v < apex(m, h))
        sum += six_volumes_of(from, m.position[v], m.position[head(m, h)], m.position[apex(m, h)]);
    });
  return sum;
}

void remove_component(Workspace& w) {
  Edit& e = w.edit;
  for (u32 v : w.work_vertices)
    for_each_outgoing(e.mesh, v, [&](u32 h) {
      if (!face_lives(e.mesh, face_of(h))) return;
      remove(w.near_faces, face_of(h));
      delete_face(e, face_of(h));
    });
  for (u32 v : w.work_vertices) delete_vertex(e, v);
}

// Components that a cut made, smaller than the triangles that were cut and a small part of all bodies, are no objects
// but leftovers of the seam.
void drop_specks(Attempt& a, f64 spacing, f64 six_volumes_of_all) {
  constexpr u32 most_vertices = 64;
  Workspace& w = a.w;
  const f64 largest = min_of(6 * spacing * spacing * spacing, speck_share * six_volumes_of_all);
  for (u32 v : w.edit.journal.vertices) {
    if (has_stopped(a.meter())) return;
    if (!is_new(w.edit, v) || !collect_small_component(w, v, most_vertices)) continue;
    const f64 volume = six_volumes_of_component(w);
    if (abs_of(volume) >= largest) continue;
    a.region.add_volume(-volume);
    remove_component(w);
  }
}

}  // namespace

void tidy_cut(Attempt& a, f64 spacing) {
  spend(a.meter(), a.w.edit.mesh.face_count / 4);
  const f64 volume = six_volumes(a.w.edit.mesh);
  drop_specks(a, spacing, volume);
  merge_new_vertices(a, closest_share * spacing, a.region.volume() + merging_share * volume);
}

}  // namespace tpa
