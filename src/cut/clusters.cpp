// SPDX-License-Identifier: MIT
#include "cut/clusters.h"

#include "base/disjoint_sets.h"

namespace tpa {

namespace {

// Joins members across edges.
void join_members(const Mesh& m, const Clusters& r, u32* parent) {
  // No processor predicts which edges join: edges are listed without a branch, and joined afterwards.
  constexpr u32 most = 64;
  u32 edge[most], count = 0;
  const auto join = [&] {
    for (u32 i = 0; i < count; ++i) join_sets(parent, tail(m, edge[i]), head(m, edge[i]));
    count = 0;
  };
  for (u32 v : r.members)
    for_each_outgoing(m, v, [&](u32 h) {
      const u32 u = head(m, h);
      edge[count] = h;
      count += u32{in_cluster(r, u)} & u32{u < v};
      if (count == most) join();
    });
  join();
}

}  // namespace

u32 find_cluster(const Clusters& r, u32 v) { return find_set(r.cluster, v); }

u32 cluster_of_face(const Mesh& m, const Clusters& r, u32 f) {
  return find_cluster(r, m.corner[3 * f]);  // as of the other corners, its neighbours
}

namespace {

void forget_loops(Clusters& r) {
  r.cuts.clear();
  r.loops.clear();
  r.pieces.clear();
  r.groups = 0;
}

}  // namespace

void forget_clusters(Clusters& r) {
  for (u32 v : r.members) r.cluster[v] = none;
  r.members.clear();
  forget_loops(r);
  r.removed_patches = r.removed_patch_vertices = 0;
}

// ---------------------------------------------------------------- components of colliding vertices

namespace {

// In Clusters::cluster: a vertex that is looked at, and in no cluster yet.
constexpr u32 pending = none - 1;

bool is_settled(const Clusters& r, u32 v) { return r.cluster[v] < pending; }

void add_member(Clusters& r, u32 v) {
  if (in_cluster(r, v)) return;
  r.cluster[v] = v;
  r.members.push(v);
}

void add_colliding(const Mesh& m, Span<const Contact> contacts, Clusters& r) {
  for (const Contact& c : contacts)
    for (u32 i = 0; i < 3; ++i) {
      add_member(r, m.corner[3 * c.a + i]);
      add_member(r, m.corner[3 * c.b + i]);
    }
}

// Do neighbours of v lie in two different clusters?
bool is_common_neighbour(const Mesh& m, Clusters& r, u32 v, u64& units) {
  u32 first = none;
  bool two = false;
  for_each_neighbour(m, v, [&](u32 u) {
    ++units;
    if (!is_settled(r, u)) return;
    const u32 root = find_set(r.cluster, u);
    if (first == none) first = root;
    two = two || root != first;
  });
  return two;
}

// Appends to the members the neighbours of members[first ..] that are common to two clusters, still pending.
void list_common_neighbours(const Mesh& m, Clusters& r, u32 first) {
  const u32 end = r.members.size;
  for (u32 i = first; i < end; ++i)
    for_each_neighbour(m, r.members[i], [&](u32 u) {
      if (in_cluster(r, u)) return;
      r.cluster[u] = pending;
      r.members.push(u);
    });
  u32 kept = end;
  u64 units = 4 * u64{end - first};
  for (u32 i = end; i < r.members.size; ++i) {
    const u32 v = r.members[i];
    if (is_common_neighbour(m, r, v, units))
      r.members[kept++] = v;
    else
      r.cluster[v] = none;
  }
  r.members.size = kept;
  spend(r.meter, units);
}

// One round of merging, for the neighbours of members[first ..]: each member serves in one round only. Returns the
// place of the first new member.
u32 merge_clusters(const Mesh& m, Clusters& r, u32 first) {
  const u32 end = r.members.size;
  list_common_neighbours(m, r, first);
  // Of two new members that are neighbours, the later finds the earlier settled.
  for (u32 i = end; i < r.members.size; ++i) {
    const u32 v = r.members[i];
    r.cluster[v] = v;
    for_each_neighbour(m, v, [&](u32 u) {
      if (is_settled(r, u)) join_sets(r.cluster, v, u);
    });
  }
  return end;
}

}  // namespace

void gather_clusters(const Mesh& m, Span<const Contact> contacts, Clusters& r) {
  spend(r.meter, 3 * u64{contacts.size});
  add_colliding(m, contacts, r);
  join_members(m, r, r.cluster);
  for (u32 first = 0; first < r.members.size && !has_stopped(r.meter);) first = merge_clusters(m, r, first);
}

// ---------------------------------------------------------------- local refinement: loops of cuts

namespace {

struct LoopSearch {
  const Mesh& m;
  Clusters& r;
  u64 cuts_needed = 0;
  bool fits = true;
};

u8 bit_in_face(u32 h) { return static_cast<u8>(1u << index_in_face(h)); }

// The face to the left of a cut edge has one other cut edge: to the apex, or from the apex.
u32 next_cut_edge(const Mesh& m, const Clusters& r, u32 h) {
  return m.opposite[in_cluster(r, apex(m, h)) ? next_edge(h) : previous_edge(h)];
}

void walk_loop(LoopSearch& q, u32 start) {
  Clusters& r = q.r;
  const u32 first = r.cuts.size;
  u32 h = start;
  do {
    u8& walked = r.walked[face_of(h)];
    walked = static_cast<u8>(walked | bit_in_face(h));
    q.fits = r.cuts.push({h, none, head(q.m, h), none, 1}) && q.fits;
    ++q.cuts_needed;
    h = next_cut_edge(q.m, r, h);
  } while (h != start);
  if (q.fits) q.fits = r.loops.push({first, r.cuts.size - first, tail(q.m, start), none, none});
}

void forget_walked(const LoopSearch& q) {
  for (const Cut& c : q.r.cuts) q.r.walked[face_of(c.half_edge)] = 0;
  if (q.fits) return;
  // Walked edges without room for a cut lie round the clusters as well.
  for (u32 v : q.r.members) for_each_outgoing(q.m, v, [&](u32 h) { q.r.walked[face_of(h)] = 0; });
}

}  // namespace

bool find_loops(const Mesh& m, Clusters& r, u64& cuts_needed) {
  LoopSearch q{m, r};
  for (u32 v : r.members)
    for_each_outgoing(m, v, [&](u32 h) {
      if (!in_cluster(r, head(m, h)) && (r.walked[face_of(h)] & bit_in_face(h)) == 0) walk_loop(q, h);
    });
  forget_walked(q);
  spend(r.meter, 4 * u64{r.members.size} + 2 * q.cuts_needed);
  cuts_needed = q.cuts_needed;
  return q.fits;
}

// ---------------------------------------------------------------- nested objects: patches beyond the loops

namespace {

u32 first_outside(const Clusters& r, const CutLoop& loop) { return r.cuts[loop.first].outside; }

// Has the patch beyond the loop joined a cluster meanwhile?
bool is_removed(const Clusters& r, const CutLoop& loop) { return in_cluster(r, first_outside(r, loop)); }

// Does the patch beyond the loop lie on the boundary of the region? The first vertex of the loop with few enough
// neighbours tells (outer_winding()). Without such a vertex the patch is taken for boundary.
bool is_boundary_patch(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, const Clusters& r,
                       const CutLoop& loop) {
  u32 last = none;
  for (u32 i = 0; i < loop.count; ++i) {
    const u32 v = r.cuts[loop.first + i].outside;
    i32 winding;
    spend(r.meter, 4);
    if (v != last && outer_winding(m, g, v, winding_at_infinity, winding)) return winding == 0;
    last = v;
  }
  return true;
}

// The whole patch beyond the loop joins the loop's cluster, and so do all other clusters along the patch.
void remove_patch(const Mesh& m, Clusters& r, const CutLoop& loop) {
  const u32 cluster = find_cluster(r, loop.cluster), v = first_outside(r, loop), begin = r.members.size;
  r.cluster[v] = cluster;
  r.members.push(v);
  for (u32 i = begin; i < r.members.size; ++i)
    for_each_neighbour(m, r.members[i], [&](u32 u) {
      if (in_cluster(r, u)) {
        join_sets(r.cluster, r.members[i], u);
        return;
      }
      r.cluster[u] = find_set(r.cluster, cluster);
      r.members.push(u);
    });
}

void drop_removed_loops(Clusters& r) {
  u32 kept = 0;
  for (const CutLoop& loop : r.loops)
    if (!is_removed(r, loop)) r.loops[kept++] = loop;
  r.loops.size = kept;
}

void remove_swallowed_patches(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, Clusters& r) {
  for (const CutLoop& loop : r.loops) {
    if (has_stopped(r.meter)) return;
    if (is_removed(r, loop) || is_boundary_patch(m, g, winding_at_infinity, r, loop)) continue;
    const u32 before = r.members.size;
    remove_patch(m, r, loop);
    ++r.removed_patches;
    spend(r.meter, 4 * u64{r.members.size - before});
    r.removed_patch_vertices += r.members.size - before;
  }
  drop_removed_loops(r);
}

// Has v no neighbour in a cluster?
bool is_inner(const Mesh& m, const Clusters& r, u32 v, u64& units) {
  u32 h = m.vertex_edge[v];
  do {
    ++units;
    if (is_settled(r, head(m, h))) return false;
    h = rotate(m, h);
  } while (h != m.vertex_edge[v]);
  return true;
}

bool has_inner_face(const Mesh& m, const Clusters& r, u32 v, u64& units) {
  if (!is_inner(m, r, v, units)) return false;
  u32 h = m.vertex_edge[v];
  do {
    if (is_inner(m, r, head(m, h), units) && is_inner(m, r, apex(m, h), units)) return true;
    h = rotate(m, h);
  } while (h != m.vertex_edge[v]);
  return false;
}

// The number of vertices of the patch beyond a loop if the patch is a gap, too small to be an object; else none. The
// search ends as soon as the patch proves to be an object, mostly near the loop.
u32 gap_size(const Mesh& m, Clusters& r, const CutLoop& loop) {
  const u32 begin = r.members.size;
  u64 units = 1;
  const auto add = [&](u32 v) {
    r.cluster[v] = pending;
    r.members.push(v);
  };
  add(first_outside(r, loop));
  bool is_object = false;
  for (u32 i = begin; i < r.members.size && !is_object; ++i) {
    const u32 v = r.members[i];
    for_each_neighbour(m, v, [&](u32 u) {
      ++units;
      if (!in_cluster(r, u)) add(u);
    });
    is_object = has_inner_face(m, r, v, units);
  }
  spend(r.meter, units);
  const u32 size = r.members.size - begin;
  for (u32 i = begin; i < r.members.size; ++i) r.cluster[r.members[i]] = none;
  r.members.size = begin;
  return is_object ? none : size;
}

// Is the gap beyond loop i, of `size` vertices, larger than all other patches beyond loops of the same cluster?
bool is_largest_patch(const Mesh& m, Clusters& r, u32 i, u32 size) {
  const u32 cluster = find_cluster(r, r.loops[i].cluster);
  for (u32 k = 0; k < r.loops.size && !has_stopped(r.meter); ++k) {
    const CutLoop& other = r.loops[k];
    spend(r.meter, 1);
    if (k == i || is_removed(r, other) || find_cluster(r, other.cluster) != cluster) continue;
    if (gap_size(m, r, other) >= size) return false;
  }
  return true;
}

// A gap is no nested object: with a cap it would become a thin flap. The largest patch of each cluster is spared, so
// that no component of few vertices vanishes at a mere touch.
void fill_gaps(const Mesh& m, Clusters& r) {
  for (u32 i = 0; i < r.loops.size && !has_stopped(r.meter); ++i) {
    if (is_removed(r, r.loops[i])) continue;
    const u32 size = gap_size(m, r, r.loops[i]);
    if (size != none && !is_largest_patch(m, r, i, size)) remove_patch(m, r, r.loops[i]);
  }
  drop_removed_loops(r);
}

}  // namespace

void judge_patches(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, Clusters& r) {
  remove_swallowed_patches(m, g, winding_at_infinity, r);
  fill_gaps(m, r);
}

// ---------------------------------------------------------------- groups of clusters in contact

u32 number_of_group(const Mesh& m, const Clusters& r, const Contact& c) {
  return r.group_number[find_set(r.group, cluster_of_face(m, r, c.a))];
}

void form_groups(const Mesh& m, Span<const Contact> contacts, Clusters& r) {
  spend(r.meter, r.members.size + 4 * u64{contacts.size});
  for (u32 v : r.members) {
    r.group[v] = v;
    r.group_number[v] = none;
  }
  for (const Contact& c : contacts) join_sets(r.group, cluster_of_face(m, r, c.a), cluster_of_face(m, r, c.b));
  for (const Contact& c : contacts) {
    u32& number = r.group_number[find_set(r.group, cluster_of_face(m, r, c.a))];
    if (number == none) number = r.groups++;
  }
  for (CutLoop& loop : r.loops) {
    loop.cluster = find_cluster(r, loop.cluster);
    loop.group = r.group_number[find_set(r.group, loop.cluster)];
  }
}

}  // namespace tpa
