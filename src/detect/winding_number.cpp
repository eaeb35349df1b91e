// SPDX-License-Identifier: MIT
#include "detect/winding_number.h"

#include <float.h>

#include "geometry/ray.h"

namespace tpa {

namespace {

constexpr u32 largest_link = 64;

// Predicates know rays in direction +x. A ray in direction -x is one in direction +x in the mirrored mesh, which is
// inside out, so signs change.
Vec3 seen(const Vec3& p, bool mirrored) { return {mirrored ? -p.x : p.x, p.y, p.z}; }

// Writes the link of v, in the order of the fan. Returns its size, or 0 if v has more than largest_link neighbours.
u32 link_of(const Mesh& m, u32 v, bool mirrored, Vec3* link) {
  u32 n = 0;
  bool fits = true;
  for_each_neighbour(m, v, [&](u32 u) {
    fits = n < largest_link;
    if (fits) link[n++] = seen(m.position[u], mirrored);
  });
  return fits ? n : 0;
}

// Does most of the mesh lie towards +x? Then the ray goes the other way. A few vertices decide; any answer is correct.
bool is_seen_mirrored(const Mesh& m, const Vec3& p) {
  constexpr u32 asked = 8;
  f64 away = 0;
  for (u32 i = 0; i < asked; ++i) away += m.position[m.vertex_count / asked * i].x - p.x;
  return away > 0;
}

// Signed crossings of the ray from v with all faces but the star of v.
i32 crossings_of_ray(const Mesh& m, const NearFaces& g, u32 v, bool mirrored) {
  const Vec3 &p = m.position[v], from = seen(p, mirrored);
  Box ray = box_of(p, p, p);
  if (mirrored)
    ray.low[0] = -FLT_MAX;
  else
    ray.high[0] = FLT_MAX;
  i32 crossings = 0;
  for_each_near(g, ray, [&](u32 f) {
    const u32* c = m.corner + 3 * f;
    if (c[0] == v || c[1] == v || c[2] == v) return;
    crossings += ray_crossing(from, seen(m.position[c[0]], mirrored), seen(m.position[c[1]], mirrored),
                              seen(m.position[c[2]], mirrored));
  });
  return mirrored ? -crossings : crossings;
}

// The side of the star of v on which the ray runs: 1 outside, -1 inside, 0 unknown.
int side_of_star(const Mesh& m, u32 v, bool mirrored) {
  Points<largest_link> room;
  Vec3* const link = room.data();
  const u32 n = link_of(m, v, mirrored, link);
  const Vec3 p = seen(m.position[v], mirrored);
  int side = ray_leaves_star(p, link, n);
  if (side == 0) side = side_beside_triangle(p, link, n);
  if (side == 0) side = side_beside_corner(p, link, n);
  return mirrored ? -side : side;
}

}  // namespace

bool outer_winding(const Mesh& m, const NearFaces& g, u32 v, i32 winding_at_infinity, i32& winding) {
  const bool mirrored = is_seen_mirrored(m, m.position[v]);
  const int side = side_of_star(m, v, mirrored);
  if (side == 0) return false;
  const i32 above = winding_at_infinity + crossings_of_ray(m, g, v, mirrored);
  winding = side > 0 ? above : above - 1;
  return true;
}

}  // namespace tpa
