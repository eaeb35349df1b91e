#include "winding.h"

#include <float.h>

#include "predicates.h"

namespace tpa {

bool outer_winding(const Mesh& m, const Grid& g, u32 v, i32 winding_at_infinity, i32& winding) {
  constexpr u32 largest_star = 64;
  Vec3 link[largest_star];
  u32 n = 0;
  bool fits = true;
  for_each_outgoing(m, v, [&](u32 h) {
    if (n == largest_star)
      fits = false;
    else
      link[n++] = m.position[head(m, h)];
  });
  const Vec3& p = m.position[v];
  int side = fits ? ray_leaves_star(p, link, n) : 0;
  if (fits && side == 0) side = side_of_flat_star(p, link, n);
  if (side == 0) return false;
  Box ray = box_of(p, p, p);
  ray.high[0] = FLT_MAX;
  i32 crossings = 0;
  for_each_near(g, ray, [&](u32 f) {
    const u32* c = m.corner + 3 * f;
    if (c[0] == v || c[1] == v || c[2] == v) return;
    crossings += ray_crossing(p, m.position[c[0]], m.position[c[1]], m.position[c[2]]);
  });
  const i32 above = winding_at_infinity + crossings;
  winding = side > 0 ? above : above - 1;
  return true;
}

}  // namespace tpa
