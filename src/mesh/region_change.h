// SPDX-License-Identifier: MIT
// region_change: how far operations on the surface have changed the region bounded by the surface, as sums of the
// volumes taken from the region and added to it by each operation.
#pragma once

#include "mesh/half_edges.h"
#include "mesh/volume.h"

namespace tpa {

struct RegionChange {
  f64 lost = 0, gained = 0;  // six times the volumes
  f64 reach = 0;             // no change lies farther from where surfaces met

  // Six times a signed volume.
  void add_volume(f64 change) { (change < 0 ? lost : gained) += abs_of(change); }
  void add_reach(f64 way) { reach = max_of(reach, way); }
  // Vertex v moves from `from` to `to`: each face sweeps a tetrahedron. Neighbours are taken where they are now: an
  // estimate, where these have moved as well.
  void add_move(const Mesh& m, u32 v, const Vec3& from, const Vec3& to) {
    if (from == to) return;
    for_each_outgoing(
        m, v, [&](u32 h) { add_volume(six_volumes_of(from, to, m.position[head(m, h)], m.position[apex(m, h)])); });
    add_reach(length(to - from));
  }
  void add(const RegionChange& other) {
    lost += other.lost;
    gained += other.gained;
    add_reach(other.reach);
  }
  f64 volume() const { return lost + gained; }
};

}  // namespace tpa
