// SPDX-License-Identifier: MIT
// region_change: how far operations on the surface have changed the region bounded by the surface, as sums of the
// volumes taken from the region and added to it by each operation, and how far from faces in contact.
#pragma once

#include "mesh/faces_in_contact.h"
#include "mesh/volume.h"

namespace tpa {

// The radius of a ball of a volume, or a little more: no point of a body with this volume lies deeper. The fourth root
// and the fourth roots of that, and so on, make the third root as 1/4 + 1/16 + ... make 1/3.
inline f64 depth_of(f64 six_volumes) {
  constexpr f64 six_volumes_of_ball = 25.132741228718345;  // 8 pi, of radius 1
  f64 part = six_volumes / six_volumes_of_ball, root = 1 + 0x1p-20;
  for (u32 i = 0; i < 16; ++i) {
    part = square_root(square_root(part));
    root *= part;
  }
  return root;
}

struct RegionChange {
  f64 lost = 0, gained = 0;       // six times the volumes
  f64 reach = 0;                  // no change lies farther from the faces in contact, nor others known before
  FacesInContact* met = nullptr;  // these faces; without them the reach stays 0

  // Six times a signed volume.
  void add_volume(f64 change) { (change < 0 ? lost : gained) += abs_of(change); }
  void add_reach(f64 far) { reach = max_of(reach, far); }
  // All changes lie within the hull of some points. `near`: a face in contact, or none (mesh/faces_in_contact.h).
  void add_hull(const Vec3* points, u32 count, u32 near) {
    if (met != nullptr) reach = met->reach_of(points, count, near, reach);
  }
  // Changes of a volume are bounded by hulls: hulls(so_far) returns the greatest reach of one, or so_far.
  template <class Hulls>
  void add_bounded(f64 six_volumes, Hulls hulls) {
    const f64 depth = depth_of(six_volumes), so_far = max_of(0.0, reach - depth), far = hulls(so_far);
    if (far > so_far || so_far == 0) add_reach(far + depth);
  }
  // A face of the fan round v sweeps a tetrahedron: from one place of v to another, and the other two corners.
  void add_sweep(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, u32 v, u32 f);
  // Vertex v moves from `from` to `to`. Neighbours are taken where they are now: an estimate, where these have moved as
  // well.
  void add_move(const Mesh& m, u32 v, const Vec3& from, const Vec3& to) {
    if (from == to) return;
    for_each_outgoing(
        m, v, [&](u32 h) { add_sweep(from, to, m.position[head(m, h)], m.position[apex(m, h)], v, face_of(h)); });
  }
  void add(const RegionChange& other) {
    lost += other.lost;
    gained += other.gained;
    add_reach(other.reach);
  }
  f64 volume() const { return lost + gained; }
};

}  // namespace tpa
