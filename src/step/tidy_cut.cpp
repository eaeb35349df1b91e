// SPDX-License-Identifier: MIT
#include "step/tidy_cut.h"

#include "detect/hub_stars.h"
#include "edit/bisect.h"
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
  HubStars hubs;
  w.near_faces.hubs = &hubs;
  for (u32 round = 0, merged = 1; merged > 0 && round < most_rounds; ++round) {
    merged = 0;
    for (u32 v : w.edit.journal.vertices) {
      if (has_stopped(a.meter())) break;
      if (is_new(w.edit, v) && merge_with_neighbour(a, v, closest, allowed)) ++merged;
    }
  }
  w.near_faces.hubs = nullptr;
}

}  // namespace

CutSizes sizes_of_contacts(const Workspace& w) {
  const Mesh& m = w.edit.mesh;
  CutSizes sum;
  const auto add = [&](u32 f) {
    f64 shortest = no_way, longest = 0;
    for (u32 h = 3 * f; h < 3 * f + 3; ++h) {
      shortest = min_of(shortest, squared_edge(m, h));
      longest = max_of(longest, squared_edge(m, h));
    }
    sum.spacing += square_root(shortest);
    sum.longest += square_root(longest);
    sum.triangle += square_root(length(face_normal(m, f)));
  };
  for (const Contact& c : w.detection.pairs) {
    add(c.a);
    add(c.b);
  }
  const f64 count = max_of(1.0, 2 * static_cast<f64>(w.detection.pairs.size));
  return {sum.spacing / count, sum.triangle / count, sum.longest / count};
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

struct Speck {
  f64 six_volumes = 0, area = 0;
};

// Of the component in w.work_vertices.
Speck measure_speck(const Workspace& w) {
  const Mesh& m = w.edit.mesh;
  const Vec3& from = m.position[w.work_vertices[0]];
  Speck speck;
  for (u32 v : w.work_vertices)
    for_each_outgoing(m, v, [&](u32 h) {
      if (v > head(m, h) || v > apex(m, h)) return;
      speck.six_volumes += six_volumes_of(from, m.position[v], m.position[head(m, h)], m.position[apex(m, h)]);
      speck.area += 0.5 * length(face_normal(m, face_of(h)));
    });
  return speck;
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

// Components that a cut made are leftovers of the seam and no objects, if they are smaller than the triangles that were
// cut, or voids thinner than those, and a small part of all bodies.
bool is_speck(const Speck& speck, const CutSizes& sizes, f64 six_volumes_of_all) {
  const f64 six_volumes = abs_of(speck.six_volumes);
  if (six_volumes >= speck_share * six_volumes_of_all) return false;
  const bool thin = speck.six_volumes < 0 && six_volumes < sizes.triangle * speck.area;
  return thin || six_volumes < 6 * sizes.spacing * sizes.spacing * sizes.spacing;
}

}  // namespace

void drop_specks(Attempt& a, const CutSizes& sizes) {
  constexpr u32 most_vertices = 64;
  Workspace& w = a.w;
  spend(a.meter(), w.edit.mesh.face_count / 4);
  const f64 all = six_volumes(w.edit.mesh, a.t.exec);
  for (u32 v : w.edit.journal.vertices) {
    if (has_stopped(a.meter())) return;
    if (!is_new(w.edit, v) || !collect_small_component(w, v, most_vertices)) continue;
    const Speck speck = measure_speck(w);
    if (!is_speck(speck, sizes, all)) continue;
    a.region.add_volume(-speck.six_volumes);
    remove_component(w);
  }
}

void tidy_cut(Attempt& a, const CutSizes& sizes) {
  drop_specks(a, sizes);
  merge_new_vertices(a, closest_share * sizes.spacing,
                     a.region.volume() + merging_share * six_volumes(a.w.edit.mesh, a.t.exec));
}

}  // namespace tpa
