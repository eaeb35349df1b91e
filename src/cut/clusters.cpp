#include "cut/clusters.h"

#include "base/disjoint_sets.h"

namespace tpa {

namespace {

// In Clusters.cluster: a vertex that may join at the end of the round.
constexpr u32 pending = none - 1;

bool settled(const Clusters& r, u32 v) { return r.cluster[v] < pending; }

// Do the neighbours of v lie in two different clusters?
bool bridges_clusters(const Mesh& m, Clusters& r, u32 v) {
  u32 first = none;
  bool two = false;
  for_each_neighbour(m, v, [&](u32 u) {
    if (!settled(r, u)) return;
    const u32 root = find_set(r.cluster, u);
    if (first == none) first = root;
    two = two || root != first;
  });
  return two;
}

// One round of growth round members[first ..], whose neighbours are asked once each: returns where the new members
// start.
u32 grow(const Mesh& m, Clusters& r, u32 first) {
  const u32 end = r.members.size;
  for (u32 i = first; i < end; ++i)
    for_each_neighbour(m, r.members[i], [&](u32 u) {
      if (r.cluster[u] != none) return;
      r.cluster[u] = pending;
      r.members.push(u);
    });
  u32 kept = end;
  for (u32 i = end; i < r.members.size; ++i) {
    const u32 v = r.members[i];
    if (bridges_clusters(m, r, v))
      r.members[kept++] = v;
    else
      r.cluster[v] = none;
  }
  r.members.size = kept;
  // Of two that join, the later one meets the other.
  for (u32 i = end; i < r.members.size; ++i) {
    const u32 v = r.members[i];
    r.cluster[v] = v;
    for_each_neighbour(m, v, [&](u32 u) {
      if (settled(r, u)) join_sets(r.cluster, v, u);
    });
  }
  return end;
}

}  // namespace

void join_members(const Mesh& m, const Clusters& r, u32* parent) {
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
      count += u32{in_cluster(r, u)} & u32{u < v} & u32{!is_met(r, h)};
      if (count == most) join();
    });
  join();
}

u32 find_cluster(const Clusters& r, u32 v) { return find_set(r.cluster, v); }

bool bound_one_cluster(Span<const CutLoop> loops) {
  for (const CutLoop& loop : loops)
    if (loop.cluster != loops[0].cluster) return false;
  return true;
}

// Its corners in clusters are neighbours.
u32 cluster_of_face(const Mesh& m, const Clusters& r, u32 f) {
  const u32* c = m.corner + 3 * f;
  return find_cluster(r, in_cluster(r, c[0]) ? c[0] : in_cluster(r, c[1]) ? c[1] : c[2]);
}

namespace {

void forget_loops(Clusters& r) {
  r.cuts.clear();
  r.loops.clear();
  r.pieces.clear();
  r.groups = 0;
}

}  // namespace

void clear(Clusters& r) {
  for (u32 v : r.members) r.cluster[v] = none;
  r.members.clear();
  forget_loops(r);
  r.removed_patches = r.removed_patch_vertices = 0;
}

bool comes_from_marked(const Mesh& m, const u8* marks, u8 which, u32 v) {
  for (u32 parent : m.vertex_origin[v].parents)
    if (parent != none && (marks[parent] & which) != 0) return true;
  return false;
}

void gather(const Mesh& m, Span<const Contact> contacts, const u8* marks, Clusters& r) {
  const auto add = [&](u32 v) {
    if (r.cluster[v] != none) return;
    r.cluster[v] = v;
    r.members.push(v);
  };
  for (const Contact& c : contacts)
    for (u32 i = 0; i < 3; ++i) {
      add(m.corner[3 * c.a + i]);
      add(m.corner[3 * c.b + i]);
    }
  for (u32 i = 0; marks != nullptr && i < r.members.size; ++i)
    for_each_neighbour(m, r.members[i], [&](u32 u) {
      if (is_old(m, u) && (marks[u] & taken_along) != 0) add(u);
    });
  join_members(m, r, r.cluster);
  for (u32 first = 0; first < r.members.size;) first = grow(m, r, first);
}

void release(const Mesh& m, Clusters& r) {
  u32 kept = 0;
  for (u32 i = 0; i < r.members.size; ++i) {
    const u32 v = r.members[i];
    r.cluster[v] = r.number[v] != 0 ? none : v;
    if (in_cluster(r, v)) r.members[kept++] = v;
  }
  r.members.size = kept;
  forget_loops(r);
  join_members(m, r, r.cluster);
}

bool find_loops(const Mesh& m, Clusters& r, u64& cuts_needed) {
  cuts_needed = 0;
  bool fits = true;
  const auto bit = [](u32 h) { return static_cast<u8>(1u << h % 3); };
  const auto walk = [&](u32 start) {
    const u32 first = r.cuts.size;
    u32 h = start;
    do {
      r.visited[face_of(h)] = static_cast<u8>(r.visited[face_of(h)] | bit(h));
      fits = r.cuts.push({h, none, head(m, h), none, 1}) && fits;
      ++cuts_needed;
      // The face on the left has a second cut edge: that to the apex, or from it.
      h = in_cluster(r, apex(m, h)) ? m.opposite[next_edge(h)] : m.opposite[previous_edge(h)];
    } while (h != start);
    if (fits) fits = r.loops.push({first, r.cuts.size - first, m.corner[start], none, none});
  };
  for (u32 v : r.members)
    for_each_outgoing(m, v, [&](u32 h) {
      if (!in_cluster(r, head(m, h)) && (r.visited[face_of(h)] & bit(h)) == 0) walk(h);
    });
  for (const Cut& c : r.cuts) r.visited[face_of(c.half_edge)] = 0;
  // Those of cuts that there is no room for, too.
  if (!fits) {
    for (u32 v : r.members) for_each_outgoing(m, v, [&](u32 h) { r.visited[face_of(h)] = 0; });
  }
  return fits;
}

namespace {

// Does the patch outside this loop belong to the boundary of the region? Where a vertex has too many neighbours to
// tell, the next one of the loop is asked.
bool patch_is_boundary(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, const Clusters& r,
                       const CutLoop& loop) {
  u32 last = none;
  for (u32 i = 0; i < loop.count; ++i) {
    const u32 v = r.cuts[loop.first + i].outside;
    i32 winding;
    if (v != last && outer_winding(m, g, v, winding_at_infinity, winding)) return winding == 0;
    last = v;
  }
  return true;
}

// The whole patch round v joins `cluster`, and so do the clusters that it touches.
void remove_patch(const Mesh& m, Clusters& r, u32 v, u32 cluster) {
  const u32 begin = r.members.size;
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

// Has v only its patch round it?
bool is_inner(const Mesh& m, const Clusters& r, u32 v) {
  bool inner = true;
  for_each_neighbour(m, v, [&](u32 u) { inner = inner && !settled(r, u); });
  return inner;
}

bool has_inner_face(const Mesh& m, const Clusters& r, u32 v) {
  if (!is_inner(m, r, v)) return false;
  bool found = false;
  for_each_outgoing(m, v, [&](u32 h) { found = found || (is_inner(m, r, head(m, h)) && is_inner(m, r, apex(m, h))); });
  return found;
}

// A tetrahedron's.
constexpr u32 closed_mesh_vertices = 4;

// How many vertices the patch outside a loop has, if it is a gap: too small to be an object. Else none. Of most patches
// this is known near the loop.
u32 gap_size(const Mesh& m, Clusters& r, LeastObject least, const CutLoop& loop) {
  const u32 begin = r.members.size;
  const auto add = [&](u32 v) {
    r.cluster[v] = pending;
    r.members.push(v);
  };
  add(r.cuts[loop.first].outside);
  bool is_object = false;
  for (u32 i = begin; i < r.members.size && !is_object; ++i) {
    const u32 v = r.members[i];
    for_each_neighbour(m, v, [&](u32 u) {
      if (!in_cluster(r, u)) add(u);
    });
    is_object =
        least == LeastObject::closed_mesh ? r.members.size - begin >= closed_mesh_vertices : has_inner_face(m, r, v);
  }
  const u32 size = r.members.size - begin;
  for (u32 i = begin; i < r.members.size; ++i) r.cluster[r.members[i]] = none;
  r.members.size = begin;
  return is_object ? none : size;
}

void drop_loops_inside(Clusters& r) {
  u32 kept = 0;
  for (const CutLoop& loop : r.loops)
    if (!in_cluster(r, r.cuts[loop.first].outside)) r.loops[kept++] = loop;
  r.loops.size = kept;
}

// A gap is no nested object: closed by a cap it would be a rim with two sides. The largest patch of each cluster is
// spared, lest a component of few vertices should vanish because something touched it.
void fill_gaps(const Mesh& m, LeastObject least, Clusters& r) {
  const auto same_cluster = [&](const CutLoop& a, const CutLoop& b) {
    return find_set(r.cluster, a.cluster) == find_set(r.cluster, b.cluster);
  };
  for (u32 i = 0; i < r.loops.size; ++i) {
    const u32 outside = r.cuts[r.loops[i].first].outside;
    if (in_cluster(r, outside)) continue;
    const u32 size = gap_size(m, r, least, r.loops[i]);
    if (size == none) continue;
    bool spare = true;
    for (u32 k = 0; k < r.loops.size && spare; ++k)
      spare = k == i || in_cluster(r, r.cuts[r.loops[k].first].outside) || !same_cluster(r.loops[i], r.loops[k]) ||
              gap_size(m, r, least, r.loops[k]) < size;
    if (!spare) remove_patch(m, r, outside, find_set(r.cluster, r.loops[i].cluster));
  }
}

}  // namespace

void judge_patches(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, LeastObject least, Clusters& r) {
  for (const CutLoop& loop : r.loops) {
    const u32 outside = r.cuts[loop.first].outside;
    if (in_cluster(r, outside)) continue;
    if (patch_is_boundary(m, g, winding_at_infinity, r, loop)) continue;
    const u32 before = r.members.size;
    remove_patch(m, r, outside, find_set(r.cluster, loop.cluster));
    ++r.removed_patches;
    r.removed_patch_vertices += r.members.size - before;
  }
  drop_loops_inside(r);
  fill_gaps(m, least, r);
  drop_loops_inside(r);
}

void form_groups(const Mesh& m, Span<const Contact> contacts, Clusters& r) {
  for (u32 v : r.members) {
    r.group[v] = v;
    r.number[v] = none;
  }
  const auto root_of_face = [&](u32 f) { return cluster_of_face(m, r, f); };
  for (const Contact& c : contacts) join_sets(r.group, root_of_face(c.a), root_of_face(c.b));
  for (const Contact& c : contacts) {
    u32& number = r.number[find_set(r.group, root_of_face(c.a))];
    if (number == none) number = r.groups++;
  }
  for (CutLoop& loop : r.loops) {
    loop.cluster = find_cluster(r, loop.cluster);
    loop.group = r.number[find_set(r.group, loop.cluster)];
  }
}

}  // namespace tpa
