// SPDX-License-Identifier: MIT
#include "cut/pieces.h"

#include "base/sort.h"
#include "mesh/volume.h"

namespace tpa {

namespace {

// The rim of the cluster's faces along a loop. Its direction is that of the faces that close it.
struct Rim {
  const Mesh& m;
  const Clusters& r;
  const CutLoop& loop;
  u32 start = 0;

  const Vec3& at(u32 i) const {
    const u32 k = start + i;
    return m.position[r.cuts[loop.first + (k < loop.count ? k : k - loop.count)].outside];
  }
};

Vec3 middle_of(const Rim& rim) {
  Vec3 sum;
  for (u32 i = 0; i < rim.loop.count; ++i) sum = sum + rim.at(i);
  return 1.0 / rim.loop.count * sum;
}

f64 length_of(const Rim& rim) {
  f64 sum = 0;
  for (u32 i = 0; i < rim.loop.count; ++i) sum += length(rim.at(i + 1) - rim.at(i));
  return sum;
}

// A fan round the middle stands for the cap.
f64 cone_over_cap(const Rim& rim, const Vec3& from) {
  const Vec3 middle = middle_of(rim);
  f64 sum = 0;
  for (u32 i = 0; i < rim.loop.count; ++i) sum += six_volumes_of(from, middle, rim.at(i), rim.at(i + 1));
  return sum;
}

u32 nearest_on(const Rim& rim, const Vec3& p) {
  u32 nearest = 0;
  for (u32 i = 1; i < rim.loop.count; ++i)
    if (squared_length(rim.at(i) - p) < squared_length(rim.at(nearest) - p)) nearest = i;
  return nearest;
}

// A strip stands for the band: from a pair of near vertices, both rims in step by their lengths. The second rim runs
// against the first.
f64 cone_over_band(const Rim& a, Rim b, const Vec3& from) {
  b.start = nearest_on(b, a.at(0));
  const f64 a_length = length_of(a), b_length = length_of(b);
  const auto b_at = [&](u32 k) { return b.at(b.loop.count - k); };
  f64 sum = 0, a_done = 0, b_done = 0;
  for (u32 i = 0, k = 0; i < a.loop.count || k < b.loop.count;) {
    const bool advance_a = k == b.loop.count || (i < a.loop.count && a_done * b_length <= b_done * a_length);
    if (advance_a) {
      sum += six_volumes_of(from, a.at(i), a.at(i + 1), b_at(k));
      a_done += length(a.at(i + 1) - a.at(i));
      ++i;
    } else {
      sum += six_volumes_of(from, b_at(k + 1), b_at(k), a.at(i));
      b_done += length(b_at(k + 1) - b_at(k));
      ++k;
    }
  }
  return sum;
}

// Writes, at the vertex that names each cluster, six times the volume of the cone from there over the faces at the
// cluster's vertices.
void measure_cones(const Mesh& m, const Clusters& r, f64* cone) {
  for (u32 v : r.members) cone[v] = 0;
  for (u32 v : r.members)
    for_each_outgoing(m, v, [&](u32 h) {
      const u32 x = head(m, h), y = apex(m, h);
      if ((in_cluster(r, x) && x < v) || (in_cluster(r, y) && y < v)) return;  // counted there
      const u32 name = find_cluster(r, v);
      cone[name] += six_volumes_of(m.position[name], m.position[v], m.position[x], m.position[y]);
    });
}

enum class Closure : u8 { joined, caps, unclear };

bool clearly_less(f64 a, f64 b) { return a < 0.75 * b; }

// A rim that runs out and back along creases that branch: it encloses less area for its length than a rectangle eight
// times as long as wide. No fan and no strip stands for what closes it.
bool branches(const Rim& rim) {
  Vec3 twice_area;
  for (u32 i = 0; i < rim.loop.count; ++i)
    twice_area = twice_area + cross(rim.at(i) - rim.at(0), rim.at(i + 1) - rim.at(0));
  const f64 around = length_of(rim);
  return around * around > 18 * 18 / 8.0 * 0.5 * length(twice_area);
}

Closure choose_for_two(const Mesh& m, const Clusters& r, const CutLoop& a, const CutLoop& b, f64 cone) {
  const Vec3& from = m.position[a.cluster];
  const Rim first{m, r, a}, second{m, r, b};
  if (branches(first) && branches(second)) return Closure::unclear;
  const f64 by_band = abs_of(cone_over_band(first, second, from) - cone);
  const f64 by_caps = abs_of(cone_over_cap(first, from) + cone_over_cap(second, from) - cone);
  return clearly_less(by_band, by_caps) ? Closure::joined : Closure::caps;
}

// Cones with a common tip, in the middle of the loops, stand for a surface that joins all loops. Such a surface round
// one cluster is beyond the paper: caps or nothing.
Closure choose_for_many(const Mesh& m, const Clusters& r, Span<const CutLoop> loops, f64 cone) {
  const Vec3& from = m.position[loops[0].cluster];
  Vec3 tip;
  for (const CutLoop& loop : loops) tip = tip + 1.0 / loops.size * middle_of({m, r, loop});
  f64 caps = 0, caps_from_tip = 0;
  for (const CutLoop& loop : loops) {
    caps += cone_over_cap({m, r, loop}, from);
    caps_from_tip += cone_over_cap({m, r, loop}, tip);
  }
  return clearly_less(abs_of(caps - cone), abs_of(cone - caps + caps_from_tip)) ? Closure::caps : Closure::unclear;
}

Closure choose_closure(const Mesh& m, const Clusters& r, Span<const CutLoop> loops, const f64* cone) {
  if (loops.size == 1) return Closure::caps;
  bool all_same = true, all_differ = true;
  for (u32 i = 0; i < loops.size && (all_same || all_differ) && !has_stopped(r.meter); ++i) {
    spend(r.meter, i / 16);
    for (u32 k = 0; k < i; ++k) {
      const bool same = loops[i].cluster == loops[k].cluster;
      all_same = all_same && same;
      all_differ = all_differ && !same;
    }
  }
  if (all_differ) return Closure::joined;
  if (!all_same) return Closure::unclear;
  const f64 of_cluster = cone[loops[0].cluster];
  return loops.size == 2 ? choose_for_two(m, r, loops[0], loops[1], of_cluster)
                         : choose_for_many(m, r, loops, of_cluster);
}

}  // namespace

bool form_pieces(const Mesh& m, Clusters& r, f64* cone) {
  spend(r.meter, 6 * u64{r.members.size} + 4 * u64{r.cuts.size} + sorting_steps(r.loops.size));
  measure_cones(m, r, cone);
  // Loops of a group stay in their order: heap sort needs the place as a second key.
  for (u32 i = 0; i < r.loops.size; ++i) r.loops[i].place = i;
  sort_in_place(r.loops.data, r.loops.size, [](const CutLoop& a, const CutLoop& b) {
    return a.group != b.group ? a.group < b.group : a.place < b.place;
  });
  r.pieces.clear();
  for (u32 first = 0, end = 0; first < r.loops.size; first = end) {
    for (end = first; end < r.loops.size && r.loops[end].group == r.loops[first].group;) ++end;
    const Closure closure = choose_closure(m, r, r.loops.span().part(first, end - first), cone);
    if (closure == Closure::unclear) return false;
    if (closure == Closure::joined)
      r.pieces.push({first, end - first});
    else
      for (u32 i = first; i < end; ++i) r.pieces.push({i, 1});
  }
  return true;
}

}  // namespace tpa
