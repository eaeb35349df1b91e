// SPDX-License-Identifier: MIT
#include "detect/face_pair.h"

#include "geometry/star.h"
#include "mesh/projection.h"

namespace tpa {

namespace {

enum : u8 { star_unknown = 0, star_unfolded = 1, star_unproven = 2 };

// Calls visit(spoke, next) for each face round v.
template <class Visit>
void for_each_face_of_fan(const Mesh& m, u32 v, Visit visit) {
  const Vec3& p = m.position[v];
  for_each_outgoing(m, v, [&](u32 h) { visit(m.position[head(m, h)] - p, m.position[apex(m, h)] - p); });
}

bool prove_hub(const Mesh& m, u32 v) {
  FanNormal normal;
  for_each_face_of_fan(m, v, [&](const Vec3& spoke, const Vec3& next) { normal.add(spoke, next); });
  FanTurns turns(normal);
  for_each_face_of_fan(m, v, [&](const Vec3& spoke, const Vec3& next) { turns.add(spoke, next); });
  return turns.unfolded();
}

bool prove_star(const Mesh& m, u32 v) {
  Points<star_room> room;
  Vec3* const link = room.data();
  u32 n = 0;
  bool small = true;
  for_each_neighbour(m, v, [&](u32 u) {
    if (n == star_is_unfolded_limit)
      small = false;
    else
      link[n++] = m.position[u];
  });
  return small ? star_is_unfolded(m.position[v], link, n) : prove_hub(m, v);
}

// Does the line of an edge of f, as seen, certainly have f on one side and g on the other? Ends of the edge may be
// corners of g. Then the plane through the edge and the direction of sight has nothing of g but such ends, or the edge.
bool edge_parts(const View& w, const Mesh& m, const u32* f, const u32* g) {
  const auto seen_at = [&](u32 v) { return Point{m.position[v][w.x], m.position[v][w.y]}; };
  const Point at_f[] = {seen_at(f[0]), seen_at(f[1]), seen_at(f[2])},
              at_g[] = {seen_at(g[0]), seen_at(g[1]), seen_at(g[2])};
  for (u32 i = 0; i < 3; ++i) {
    const u32 k = (i + 1) % 3, j = (i + 2) % 3;
    const int inside = certain_sign(turn_between(at_f[i], at_f[k], at_f[j]));
    if (inside == 0) continue;
    const auto is_outside = [&](u32 c) {
      return g[c] == f[i] || g[c] == f[k] || certain_sign(turn_between(at_f[i], at_f[k], at_g[c])) == -inside;
    };
    if (is_outside(0) && is_outside(1) && is_outside(2)) return true;
  }
  return false;
}

}  // namespace

// Two threads may prove the same star at once: both write the same byte.
bool star_proven(const Mesh& m, u8* star, u32 v) {
  u8 state = __atomic_load_n(star + v, __ATOMIC_RELAXED);
  if (state == star_unknown) {
    state = prove_star(m, v) ? star_unfolded : star_unproven;
    __atomic_store_n(star + v, state, __ATOMIC_RELAXED);
  }
  return state == star_unfolded;
}

bool corners_meet(const Mesh& m, const u32* f, const u32* g) {
  const Vec3* p = m.position;
  const u32 of_f = shared_corners(f, g), of_g = shared_corners(g, f);
  if (of_f == 0) return triangles_meet(triangle_of(m, f), triangle_of(m, g));
  if (of_f == 7) return true;
  const bool share_one = (of_f & (of_f - 1)) == 0;
  // The odd corner of each face: the only shared corner, or the only corner not shared.
  const u32 i = static_cast<u32>(__builtin_ctz(share_one ? of_f : 7 ^ of_f));
  const u32 j = static_cast<u32>(__builtin_ctz(share_one ? of_g : 7 ^ of_g));
  const Vec3 &a = p[f[i]], &a1 = p[f[(i + 1) % 3]], &a2 = p[f[(i + 2) % 3]];
  return share_one ? triangles_meet_beyond_vertex(a, a1, a2, p[g[(j + 1) % 3]], p[g[(j + 2) % 3]])
                   : triangles_meet_beyond_edge(a1, a2, a, p[g[j]]);
}

bool meets(const Mesh& m, const Probe& f, const u32* g) {
  if (lies_beside(m, f, g)) return false;
  const View w = view_along(f.plane.normal);
  return !edge_parts(w, m, f.v, g) && !edge_parts(w, m, g, f.v) && !lies_beside(m, probe_of(m, g), f.v) &&
         corners_meet(m, f.v, g);
}

}  // namespace tpa
