// SPDX-License-Identifier: MIT
#include "cut/snap_cuts.h"

#include "base/sort.h"

namespace tpa {

namespace {

struct Loops {
  const Mesh& m;
  Clusters& r;
  u8* mark;  // per vertex: 1 if cuts may be snapped to the vertex

  Cut& cut(const CutLoop& loop, u32 i) const { return r.cuts[loop.first + (i < loop.count ? i : i - loop.count)]; }
  u32 outside(const CutLoop& loop, u32 i) const { return cut(loop, i).outside; }
  // Is cut i the last of a stretch of cuts with the same vertex outside?
  bool is_last(const CutLoop& loop, u32 i) const { return outside(loop, i) != outside(loop, i + 1); }
};

// A stretch: consecutive cuts of a loop with the same vertex outside.
void count_stretches(const Loops& l) {
  for (const CutLoop& loop : l.r.loops)
    for (u32 i = 0; i < loop.count; ++i) l.r.stretches[l.outside(loop, i)] = 0;
  for (const CutLoop& loop : l.r.loops)
    for (u32 i = 0; i < loop.count; ++i)
      if (l.is_last(loop, i)) ++l.r.stretches[l.outside(loop, i)];
}

// Is a marked vertex joined to v by an edge between two faces outside? New faces might get the same edge, as they may
// join any two corners of loops.
bool clashes(const Loops& l, u32 v) {
  bool found = false;
  for_each_outgoing(l.m, v, [&](u32 h) {
    found = found || (l.mark[head(l.m, h)] != 0 && !in_cluster(l.r, apex(l.m, h)) &&
                      !in_cluster(l.r, apex(l.m, l.m.opposite[h])));
  });
  return found;
}

void unmark(const Loops& l, const CutLoop& loop) {
  for (u32 i = 0; i < loop.count; ++i) l.mark[l.outside(loop, i)] = 0;
}

// Marks vertices for cuts to be snapped to. False if the loop has none, or would have fewer than three corners.
bool choose(const Loops& l, const CutLoop& loop) {
  u32 chosen = 0, corners = 0;
  for (u32 i = 0; i < loop.count; ++i) {
    const u32 v = l.outside(loop, i);
    if (!l.is_last(loop, i) || l.r.stretches[v] != 1 || clashes(l, v)) continue;
    l.mark[v] = 1;
    ++chosen;
  }
  for (u32 i = 0; i < loop.count; ++i)
    if (l.is_last(loop, i) || l.mark[l.outside(loop, i)] == 0) ++corners;
  if (corners < 3) unmark(l, loop);
  return chosen > 0 && corners >= 3;
}

// Snaps the cuts of marked vertices. The last cut of a stretch stands for all of its cuts, and gets the mean of
// their middles.
void snap(const Loops& l, const CutLoop& loop) {
  const Vec3* position = l.m.position;
  u32 begin = 0;
  while (!l.is_last(loop, begin)) ++begin;
  Vec3 sum;
  u32 count = 0;
  for (u32 k = 1; k <= loop.count; ++k) {
    const u32 i = begin + k < loop.count ? begin + k : begin + k - loop.count;
    const u32 v = l.outside(loop, i);
    sum = sum + position[tail(l.m, l.cut(loop, i).half_edge)];
    ++count;
    if (l.mark[v] != 0) l.cut(loop, i).vertex = v;
    if (!l.is_last(loop, i)) continue;
    l.r.middle[loop.first + i] = into_exact_range(0.5 * (position[v] + 1.0 / count * sum));
    sum = {};
    count = 0;
  }
}

}  // namespace

void snap_cuts(const Mesh& m, Clusters& r, u8* vertex_mark) {
  spend(r.meter, 12 * u64{r.cuts.size});
  const Loops l{m, r, vertex_mark};
  count_stretches(l);
  for (const CutLoop& loop : r.loops)
    if (choose(l, loop)) snap(l, loop);
  for (const CutLoop& loop : r.loops) unmark(l, loop);
}

Span<const Cut> collect_snapped(Clusters& r) {
  // Loops in the order of their cuts: no cut is overwritten before its turn.
  sort_in_place(r.loops.data, r.loops.size, [](const CutLoop& a, const CutLoop& b) { return a.first < b.first; });
  u32 kept = 0;
  for (const CutLoop& loop : r.loops)
    for (u32 i = loop.first; i < loop.first + loop.count; ++i)
      if (is_snapped(r.cuts[i])) move_cut(r, i, kept++);
  return {r.cuts.data, kept};
}

}  // namespace tpa
