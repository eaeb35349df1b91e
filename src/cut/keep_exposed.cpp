// SPDX-License-Identifier: MIT
#include "cut/keep_exposed.h"

namespace tpa {

namespace {

// A vertex without a known winding number may be seen.
bool may_be_seen(const SeamScratch& s, u32 v) { return s.winding[v] == 0 || s.winding[v] == unknown_winding; }

bool has_swallowed_corner(const Mesh& m, const SeamScratch& s, u32 f) {
  const u32* c = m.corner + 3 * f;
  return !may_be_seen(s, c[0]) || !may_be_seen(s, c[1]) || !may_be_seen(s, c[2]);
}

// Faces of the same direction that cross at less than 30 degrees come out of each other by half their length at most.
constexpr f64 least_squared_sine = 0.25;

bool cross_steeply(const Mesh& m, u32 f, u32 g) {
  const Vec3 a = area_normal(corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2)),
             b = area_normal(corner_position(m, 3 * g), corner_position(m, 3 * g + 1), corner_position(m, 3 * g + 2));
  return dot(a, b) <= 0 || squared_length(cross(a, b)) >= least_squared_sine * squared_length(a) * squared_length(b);
}

// Each cluster's steep contacts with others less the flat contacts: a cluster of mostly flat contacts lies upon
// another.
void weigh_contacts(const Mesh& m, Span<const Contact> contacts, Clusters& r, const SeamScratch& s) {
  for (u32 v : r.members) r.steepness[v] = 0;
  for (const Contact& c : contacts) {
    const u32 a = cluster_of_face(m, r, c.a), b = cluster_of_face(m, r, c.b);
    if (a == b || !faces_cross(m, s, c.a, c.b)) continue;
    const i32 weight = cross_steeply(m, c.a, c.b) ? 1 : -1;
    r.steepness[a] += weight;
    r.steepness[b] += weight;
  }
}

}  // namespace

u32 keep_exposed(const Mesh& m, Span<const Contact> contacts, const u8* marks, Clusters& r, const SeamScratch& s) {
  weigh_contacts(m, contacts, r, s);
  const auto lies_upon_another = [&](u32 cluster) { return r.steepness[cluster] < 0; };
  u8* stays = r.stays;
  for (u32 v : r.members) stays[v] = s.winding[v] == 0 && !comes_from_marked(m, marks, taken_along, v) ? 1 : 0;
  const auto takes_all = [&](u32 f) {
    for (u32 i = 0; i < 3; ++i) stays[m.corner[3 * f + i]] = 0;
  };
  for (const Contact& c : contacts) {
    const u32 a = cluster_of_face(m, r, c.a), b = cluster_of_face(m, r, c.b);
    const bool apart = a != b && !lies_upon_another(a) && !lies_upon_another(b) && faces_cross(m, s, c.a, c.b);
    if (!apart || !has_swallowed_corner(m, s, c.a)) takes_all(c.a);
    if (!apart || !has_swallowed_corner(m, s, c.b)) takes_all(c.b);
  }
  // A pierced edge with both ends visible would have no vertex to go.
  for (const Piercing& p : s.piercings) {
    const u32 a = tail(m, p.edge), b = head(m, p.edge);
    if (may_be_seen(s, a) && may_be_seen(s, b)) stays[a] = stays[b] = 0;
  }
  u32 count = 0;
  for (u32 v : r.members) count += stays[v];
  if (count > 0) drop_staying(m, r);
  return count;
}

}  // namespace tpa
