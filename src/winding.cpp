#include "winding.h"

#include <float.h>

#include "predicates.h"

namespace tpa {

namespace {

constexpr u32 largest_star = 64;

// What a ray in direction +x meets is asked of the mesh as it is, or mirrored: in x, then the ray runs the other way;
// in y, then it is moved to the other side there.
struct Mirror {
  bool x, y;
  bool turns() const { return x != y; }
};
Vec3 seen(const Vec3& p, Mirror in) { return {in.x ? -p.x : p.x, in.y ? -p.y : p.y, p.z}; }

// Of the fan round v, in the order in which it goes round outward. None where there are too many.
u32 link_of(const Mesh& m, u32 v, Mirror in, Vec3* link) {
  u32 n = 0;
  bool fits = true;
  for_each_neighbour(m, v, [&](u32 u) {
    fits = n < largest_star;
    if (fits) link[n++] = seen(m.position[u], in);
  });
  for (u32 i = 0; in.turns() && i < n / 2; ++i) swap_values(link[i], link[n - 1 - i]);
  return fits ? n : 0;
}

// To the side that most of the mesh is not on, as some of its vertices tell: what the tree was arranged by would tell of
// steps before.
Mirror mirror_at(const Mesh& m, const Vec3& p) {
  constexpr u32 asked = 8;
  f64 away = 0;
  for (u32 i = 0; i < asked; ++i) away += m.position[m.vertex_count / asked * i].x - p.x;
  return {away > 0, false};
}

// Signed crossings of the ray from p with all faces but those round vertex v, if any.
i32 crossings_of_ray(const Mesh& m, const Grid& g, const Vec3& p, u32 v, Mirror in) {
  const Vec3 from = seen(p, in);
  const u32 turned = in.turns() ? 1 : 0;
  Box ray = box_of(p, p, p);
  if (in.x)
    ray.low[0] = -FLT_MAX;
  else
    ray.high[0] = FLT_MAX;
  i32 crossings = 0;
  for_each_near(g, ray, [&](u32 f) {
    const u32* c = m.corner + 3 * f;
    if (c[0] == v || c[1] == v || c[2] == v) return;
    crossings += ray_crossing(from, seen(m.position[c[0]], in), seen(m.position[c[1 + turned]], in),
                              seen(m.position[c[2 - turned]], in));
  });
  return crossings;
}

}  // namespace

bool outer_winding(const Mesh& m, const Grid& g, u32 v, i32 winding_at_infinity, i32& winding) {
  Points<largest_star> room;
  Vec3* const link = room.data();
  const Vec3& p = m.position[v];
  Mirror in = mirror_at(m, p);
  int side = 0;
  for (u32 turn = 0; turn < 2 && side == 0; ++turn) {
    in.y = turn == 1;
    side = ray_leaves_star(seen(p, in), link, link_of(m, v, in, link));
  }
  if (side == 0) {
    in.y = false;
    side = side_of_flat_star(seen(p, in), link, link_of(m, v, in, link));
  }
  if (side == 0) return false;
  const i32 above = winding_at_infinity + crossings_of_ray(m, g, p, v, in);
  winding = side > 0 ? above : above - 1;
  return true;
}

i32 winding_at(const Mesh& m, const Grid& g, const Vec3& p, i32 winding_at_infinity) {
  return winding_at_infinity + crossings_of_ray(m, g, p, none, mirror_at(m, p));
}

}  // namespace tpa
