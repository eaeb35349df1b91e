// SPDX-License-Identifier: MIT
#include "islands/tidy_cut.h"

#include "detect/hub_stars.h"
#include "edit/collapse.h"
#include "islands/rules.h"

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
bool merge_with_neighbour(Attempt& a, u32 v, f64 closest) {
  Workspace& w = a.w;
  const Mesh& m = w.edit.mesh;
  f64 squared = 0;
  const u32 u = nearest_neighbour(m, v, squared, a.meter());
  if (u == none || !(squared < closest * closest)) return false;
  const auto merge = [&](u32 goes, u32 stays) {
    RegionChange change = a.region;
    change.add_move(m, goes, m.position[goes], m.position[stays]);
    if (change.volume() > merge_share * a.ledger.bound ||
        !collapse(w.edit, w.near_faces, goes, stays, m.position[stays], m.vertex_origin[stays], Expected::bent,
                  w.relocation.face_mark))
      return false;
    a.region = change;
    return true;
  };
  return merge(v, u) || (!is_old(m, u) && merge(u, v));
}

void merge_new_vertices(Attempt& a, f64 closest) {
  Workspace& w = a.w;
  constexpr u32 most_rounds = 8;
  HubStars hubs;
  w.near_faces.hubs = &hubs;
  for (u32 round = 0, merged = 1; merged > 0 && round < most_rounds; ++round) {
    merged = 0;
    for (u32 v : w.edit.journal.claims.vertices) {
      if (has_stopped(a.meter())) break;
      if (is_new(w.edit, v) && merge_with_neighbour(a, v, closest)) ++merged;
    }
  }
  w.near_faces.hubs = nullptr;
}

}  // namespace

void tidy_cut(Attempt& a, const CutSizes& sizes) {
  drop_specks(a, sizes);
  merge_new_vertices(a, closest_share * sizes.spacing);
}

}  // namespace tpa
