#include "winding.h"

#include <float.h>

#include "predicates.h"

namespace tpa {

namespace {

constexpr u32 largest_star = 64;

// What the ray meets is asked of the mesh as it is, or mirrored in y: then the ray is moved to the other side in y.
Vec3 seen(const Vec3& p, bool mirrored) { return mirrored ? Vec3{p.x, -p.y, p.z} : p; }

// Of the fan round v, in the order in which it goes round outward. None where there are too many.
u32 link_of(const Mesh& m, u32 v, bool mirrored, Vec3* link) {
  u32 n = 0;
  bool fits = true;
  for_each_neighbour(m, v, [&](u32 u) {
    fits = n < largest_star;
    if (fits) link[n++] = seen(m.position[u], mirrored);
  });
  for (u32 i = 0; mirrored && i < n / 2; ++i) swap_values(link[i], link[n - 1 - i]);
  return fits ? n : 0;
}

}  // namespace

bool outer_winding(const Mesh& m, const Grid& g, u32 v, i32 winding_at_infinity, i32& winding) {
  Points<largest_star> room;
  Vec3* const link = room.data();
  int side = 0;
  bool mirrored = true;
  for (u32 turn = 0; turn < 2 && side == 0; ++turn) {
    mirrored = !mirrored;
    side = ray_leaves_star(seen(m.position[v], mirrored), link, link_of(m, v, mirrored, link));
  }
  const Vec3& p = m.position[v];
  if (side == 0) {
    mirrored = false;
    side = side_of_flat_star(p, link, link_of(m, v, mirrored, link));
  }
  if (side == 0) return false;

  const Vec3 from = seen(p, mirrored);
  Box ray = box_of(p, p, p);
  ray.high[0] = FLT_MAX;
  i32 crossings = 0;
  for_each_near(g, ray, [&](u32 f) {
    const u32* c = m.corner + 3 * f;
    if (c[0] == v || c[1] == v || c[2] == v) return;
    const Vec3 a = seen(m.position[c[0]], mirrored), b = seen(m.position[c[mirrored ? 2 : 1]], mirrored),
               d = seen(m.position[c[mirrored ? 1 : 2]], mirrored);
    crossings += ray_crossing(from, a, b, d);
  });
  const i32 above = winding_at_infinity + crossings;
  winding = side > 0 ? above : above - 1;
  return true;
}

i32 winding_at(const Mesh& m, const Grid& g, const Vec3& p, i32 winding_at_infinity) {
  Box ray = box_of(p, p, p);
  ray.high[0] = FLT_MAX;
  i32 winding = winding_at_infinity;
  for_each_near(g, ray, [&](u32 f) {
    const u32* c = m.corner + 3 * f;
    winding += ray_crossing(p, m.position[c[0]], m.position[c[1]], m.position[c[2]]);
  });
  return winding;
}

}  // namespace tpa
