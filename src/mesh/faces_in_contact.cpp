// SPDX-License-Identifier: MIT
#include "mesh/faces_in_contact.h"

#include "geometry/near_triangle.h"

namespace tpa {

u32 FacesInContact::near(u32 v, u32 f) const {
  const Mesh& m = moved.edit.mesh;
  if (contains(m.face_origin[f])) return m.face_origin[f];
  u32 found = none;
  for_each_outgoing(m, v, [&](u32 h) {
    const u32 origin = m.face_origin[face_of(h)];
    if (found == none && contains(origin)) found = origin;
  });
  return found;
}

// The distance from a triangle is a convex function, so it is greatest in a corner of the hull.
f64 FacesInContact::squared_reach(const Vec3* points, u32 count, u32 f, f64 at_most) const {
  const u32* const v = old_corners(moved.edit, f);
  const Triangle triangle{moved.position(v[0]), moved.position(v[1]), moved.position(v[2])};
  f64 most = 0;
  for (u32 i = 0; i < count && most <= at_most; ++i) most = max_of(most, squared_distance(points[i], triangle));
  return most;
}

f64 FacesInContact::reach_of(const Vec3* points, u32 count, u32 near, f64 so_far) {
  const f64 enough = so_far * so_far;
  const u32 first[] = {near, last};
  for (u32 f : first)
    if (f != none && squared_reach(points, count, f, enough) <= enough) return so_far;
  f64 least = no_way;
  u64 asked = 0;
  for (u32 f : faces) {
    if (least <= enough) break;
    const f64 squared = squared_reach(points, count, f, least);
    if (squared < least) least = squared, last = f;
    ++asked;
  }
  spend(meter, asked);
  return least < no_way ? max_of(so_far, square_root(least)) : so_far;
}

}  // namespace tpa
