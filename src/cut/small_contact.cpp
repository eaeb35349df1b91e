// SPDX-License-Identifier: MIT
#include "cut/small_contact.h"

namespace tpa {

namespace {

f64 area_of(const Mesh& m, u32 f) { return 0.5 * length(face_normal(m, f)); }

// Of a face with so many corners in its cluster, this share goes: cuts run through the middles of edges.
constexpr f64 share_that_goes[4] = {0, 0.25, 0.75, 1};

// The area that goes with each cluster, at the vertex that names it.
void measure_areas(const Mesh& m, const Clusters& r, f64* area) {
  for (u32 v : r.members) area[v] = 0;
  for (u32 v : r.members)
    for_each_outgoing(m, v, [&](u32 h) {
      const u32 x = head(m, h), y = apex(m, h);
      const bool has_x = in_cluster(r, x), has_y = in_cluster(r, y);
      if ((has_x && x < v) || (has_y && y < v)) return;  // counted there
      area[find_cluster(r, v)] += share_that_goes[1 + (has_x ? 1 : 0) + (has_y ? 1 : 0)] * area_of(m, face_of(h));
    });
}

// Has the surface beyond the loops of a cluster at least this area? Looks no further than that.
bool goes_on(const Mesh& m, const Clusters& r, u32 cluster, f64 wanted, u8* mark, Stack<u32>& queue) {
  queue.clear();
  const auto reach = [&](u32 v) {
    if (mark[v] != 0 || in_cluster(r, v)) return;
    mark[v] = 1;
    queue.push(v);
  };
  for (const CutLoop& loop : r.loops)
    if (find_cluster(r, loop.cluster) == cluster)
      for (u32 k = 0; k < loop.count; ++k) reach(r.cuts[loop.first + k].outside);
  f64 found = 0;
  for (u32 i = 0; i < queue.size && found < wanted; ++i)
    for_each_outgoing(m, queue[i], [&](u32 h) {
      const u32 v = queue[i], x = head(m, h), y = apex(m, h);
      if ((v < x || in_cluster(r, x)) && (v < y || in_cluster(r, y))) found += area_of(m, face_of(h));
      reach(x);
    });
  for (u32 v : queue) mark[v] = 0;
  spend(r.meter, r.loops.size / 4 + 4 * u64{queue.size});
  return found >= wanted;
}

}  // namespace

bool are_small(const Mesh& m, const Clusters& r, f64* area, u8* mark, Stack<u32>& queue) {
  spend(r.meter, 6 * u64{r.members.size});
  measure_areas(m, r, area);
  for (u32 v : r.members) {
    if (has_stopped(r.meter)) return false;
    if (find_cluster(r, v) != v) continue;
    if (!goes_on(m, r, v, max_of(area_beyond * area[v], 0x1p-1000), mark, queue)) return false;
  }
  return true;
}

}  // namespace tpa
