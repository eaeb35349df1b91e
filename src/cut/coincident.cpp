// SPDX-License-Identifier: MIT
#include "cut/coincident.h"

#include "mesh/components.h"
#include "mesh/volume.h"

namespace tpa {

namespace {

// Fewer vertices of the boundary are no loss to speak of: a fold, or a tip.
constexpr u32 least_loss = 16;

struct Sparing {
  const Mesh& m;
  Care care;
  Clusters& r;
  const SeamScratch& s;
  SparingScratch& scratch;
};

// Would most of the component's visible surface go with this cluster, more than remains of the component?
bool loses_most(Sparing& q, u32 cluster) {
  u32 lost = 0;
  for (u32 v : q.r.members)
    if (q.s.winding[v] == 0 && find_cluster(q.r, v) == cluster) ++lost;
  if (lost < least_loss) return false;
  collect_component(q.m, cluster, q.scratch.mark, q.scratch.vertices);
  u32 remaining = 0;
  for (u32 v : q.scratch.vertices)
    if (!in_cluster(q.r, v)) ++remaining;
  return lost > remaining;
}

// The upper half of the bits of a component's volume, in the order of volumes.
u32 volume_of(Sparing& q, u32 v) {
  collect_component(q.m, v, q.scratch.mark, q.scratch.vertices);
  const f64 volume = abs_of(volume_of_component(q.m, q.scratch.vertices.span()).sum);
  return static_cast<u32>(__builtin_bit_cast(u64, volume) >> 32);
}

// Flags the clusters `at_stake`; of two such clusters in contact, the winner as `spared`, the loser as `beaten`.
void choose_spared(Sparing& q, Span<const Contact> contacts) {
  u32* traits = q.r.traits;
  u32* volume = q.r.volume_rank;
  for (u32 v : q.r.members) {
    if (find_cluster(q.r, v) != v) continue;
    const bool whole = vanishes(traits[v], q.care);
    if (!whole && !(q.care == Care::boundary && (traits[v] & meets_other) != 0 && loses_most(q, v))) continue;
    traits[v] |= whole ? at_stake | spared : at_stake;
    volume[v] = volume_of(q, v);
  }
  for (const Contact& c : contacts) {
    const u32 a = cluster_of_face(q.m, q.r, c.a), b = cluster_of_face(q.m, q.r, c.b);
    if (a == b || (traits[a] & traits[b] & at_stake) == 0) continue;
    const bool a_wins = volume[a] > volume[b] || (volume[a] == volume[b] && a < b);
    traits[a_wins ? a : b] |= spared;
    traits[a_wins ? b : a] |= beaten;
  }
}

// The whole component of a beaten cluster joins the cluster; the whole component of a spared cluster leaves the
// clusters.
void take_whole_components(Sparing& q) {
  Clusters& r = q.r;
  const u32 members = r.members.size;
  for (u32 i = 0; i < members; ++i) {
    const u32 v = r.members[i];
    const u32 traits = find_cluster(r, v) == v ? r.traits[v] : 0;
    if ((traits & beaten) == 0) continue;
    collect_component(q.m, v, q.scratch.mark, q.scratch.vertices);
    for (u32 u : q.scratch.vertices)
      if (!in_cluster(r, u)) {
        r.cluster[u] = v;
        r.members.push(u);
        r.traits[u] = 0;
      }
  }
  for (u32 i = 0; i < members; ++i) r.member_traits[r.members[i]] = r.traits[find_cluster(r, r.members[i])];
  for (u32 i = 0; i < members; ++i) {
    const u32 v = r.members[i];
    if (!in_cluster(r, v) || (r.member_traits[v] & (spared | beaten)) != spared) continue;
    collect_component(q.m, v, q.scratch.mark, q.scratch.vertices);
    for (u32 u : q.scratch.vertices) r.cluster[u] = none;
  }
}

// Keeps the loops that still part a cluster from the rest.
void keep_open_loops(const Mesh& m, Clusters& r) {
  u32 pieces = 0, loops = 0;
  for (const Piece& piece : r.pieces) {
    const u32 first = loops;
    for (u32 i = piece.first_loop; i < piece.first_loop + piece.loops; ++i) {
      const u32 h = r.cuts[r.loops[i].first].half_edge;
      if (in_cluster(r, tail(m, h)) && !in_cluster(r, head(m, h))) r.loops[loops++] = r.loops[i];
    }
    if (loops > first) r.pieces[pieces++] = {first, loops - first};
  }
  r.loops.size = loops;
  r.pieces.size = pieces;
}

}  // namespace

u32 spare_largest(const Mesh& m, Span<const Contact> contacts, Care care, Clusters& r, const SeamScratch& s,
                  SparingScratch& scratch) {
  Sparing q{m, care, r, s, scratch};
  choose_spared(q, contacts);
  take_whole_components(q);
  keep_open_loops(m, r);
  u32 kept = 0;
  for (u32 i = 0; i < r.members.size; ++i)
    if (in_cluster(r, r.members[i])) swap_values(r.members[kept++], r.members[i]);
  const u32 count = r.members.size - kept;
  r.members.size = kept;
  return count;
}

}  // namespace tpa
