#include "cut/coarse_faces.h"

#include "edit/bisect.h"

namespace tpa {

namespace {

// A face whose longest edge is more than four times as long as that of a face that it meets is halved: the hole would
// be much larger than what comes through it.
constexpr f64 most_squared_ratio = 16;

// A component of more vertices all of which are in contact is not coarse: it lies upon another.
constexpr u32 most_coarse_vertices = 512;

// Per vertex that names a cluster, in Clusters.number: what is known of it, and how many vertices it has.
enum : u32 {
  has_loop = 1,
  bounds = 2,
  meets_other = 4,
  has_handle = 8,
  at_stake = 16,
  spared = 32,
  beaten = 64,
  greedy = 128,
  weighed = 256,
  one_vertex = 512
};

// By Euler's number, which is 2 less a cluster's loops and less two for each of its handles. It is counted where the
// groups were, of which there is no need any more. Those of clusters that meet others do not matter.
void flag_handles(const Mesh& m, const Clusters& r) {
  u32* sum = r.group;
  for (u32 v : r.members) sum[v] = 0;
  for (u32 v : r.members) {
    const u32 cluster = find_cluster(r, v);
    if ((r.number[cluster] & meets_other) != 0) continue;
    u32& own = sum[cluster];
    ++own;
    // Without a branch: what is in clusters is as good as random.
    for_each_outgoing(m, v, [&](u32 h) {
      const u32 edge = in_cluster(r, head(m, h)), face = edge & u32{in_cluster(r, apex(m, h))};
      own += (face & u32{index_in_face(h) == 0}) - (edge & u32{h < m.opposite[h]});
    });
  }
  for (const CutLoop& loop : r.loops) ++sum[loop.cluster];
  for (u32 v : r.members)
    if (find_cluster(r, v) == v && (r.number[v] & meets_other) == 0 && static_cast<i32>(sum[v]) < 2)
      r.number[v] |= has_handle;
}

void describe_clusters(const Mesh& m, Span<const Contact> contacts, const Clusters& r, const SeamScratch& s) {
  u32* flags = r.number;
  for (u32 v : r.members) flags[v] = 0;
  for (u32 v : r.members) {
    u32& count = flags[find_cluster(r, v)];
    if (count / one_vertex <= most_coarse_vertices) count += one_vertex;
  }
  for (const CutLoop& loop : r.loops) flags[loop.cluster] |= has_loop;
  for (u32 v : r.members)
    if (s.winding[v] == 0) flags[find_cluster(r, v)] |= bounds;
  for (const Contact& c : contacts) {
    const u32 a = cluster_of_face(m, r, c.a), b = cluster_of_face(m, r, c.b);
    if (a == b) continue;
    flags[a] |= meets_other;
    flags[b] |= meets_other;
  }
  flag_handles(m, r);
}

f64 twice_area(const Mesh& m, u32 f) {
  const Vec3& a = corner_position(m, 3 * f);
  return length(cross(corner_position(m, 3 * f + 1) - a, corner_position(m, 3 * f + 2) - a));
}

// Is what is left beyond a cluster's loops, one of which is given, less than so many times what goes with it though it
// is seen from outside, by area? Hardly more of it is looked at than that. `mark` and `faces`: as for find_coarse().
constexpr f64 least_left = 2;
bool takes_much(const Mesh& m, const Clusters& r, const SeamScratch& s, const CutLoop& loop, u8* mark,
                Stack<u32>& faces) {
  // What winding says of others is not known, and takes no part.
  const auto is_hidden = [&](u32 v) { return in_cluster(r, v) & (s.winding[v] != 0); };
  // Which faces are new is as good as random: one more is written than is counted.
  const auto add = [&](u32 f, bool wanted) {
    const bool is_new = (mark[f] == 0) & wanted;
    faces.data[faces.size] = f;
    faces.size += is_new ? 1 : 0;
    mark[f] = static_cast<u8>(mark[f] | is_new);
  };
  faces.clear();
  add(face_of(r.cuts[loop.first].half_edge), true);
  f64 area = 0;
  // A face goes where one of its corners does.
  for (u32 i = 0; i < faces.size; ++i) {
    const u32 first = 3 * faces[i];
    const u32* c = m.corner + first;
    const bool goes[] = {in_cluster(r, c[0]), in_cluster(r, c[1]), in_cluster(r, c[2])};
    if (!(is_hidden(c[0]) | is_hidden(c[1]) | is_hidden(c[2]))) area += twice_area(m, faces[i]);
    for (u32 k = 0; k < 3; ++k) {
      const u32 h = m.opposite[first + k];
      add(face_of(h), goes[k] | goes[(k + 1) % 3] | in_cluster(r, apex(m, h)));
    }
  }
  // All of what goes beside that is marked; what goes elsewhere has it in its apex, seen from what stays.
  const u32 going = faces.size;
  const f64 least = least_left * area;
  area = 0;
  for (u32 i = 0; i < faces.size && area < least; ++i) {
    const u32 first = 3 * faces[i];
    if (i >= going) area += twice_area(m, faces[i]);
    for (u32 k = 0; k < 3; ++k) {
      const u32 h = m.opposite[first + k];
      add(face_of(h), !in_cluster(r, apex(m, h)));
    }
  }
  for (u32 f : faces) mark[f] = 0;
  return area < least;
}

void flag_greedy(const Mesh& m, const Clusters& r, const SeamScratch& s, u8* mark, Stack<u32>& faces) {
  for (const CutLoop& loop : r.loops) {
    u32& flags = r.number[loop.cluster];
    if ((flags & weighed) != 0) continue;
    flags |= weighed;
    if (takes_much(m, r, s, loop, mark, faces)) flags |= greedy;
  }
}

bool vanishes(u32 flags, Care care) {
  return (flags & (has_loop | bounds)) == bounds && (care == Care::boundary || (flags & meets_other) != 0);
}

// A vertex of the boundary with all of its neighbours in clusters takes more with it than a rim.
bool buries_boundary(const Mesh& m, const Clusters& r, const SeamScratch& s, u32 f) {
  for (u32 i = 0; i < 3; ++i) {
    const u32 v = m.corner[3 * f + i];
    bool buried = in_cluster(r, v) && s.winding[v] == 0;
    for_each_neighbour(m, v, [&](u32 u) { buried = buried && in_cluster(r, u); });
    if (buried) return true;
  }
  return false;
}

bool is_too_coarse(const Mesh& m, Care care, const Clusters& r, const SeamScratch& s, u32 f) {
  const u32 flags = r.number[cluster_of_face(m, r, f)];
  const bool small = flags / one_vertex <= most_coarse_vertices;
  if ((flags & has_loop) == 0) return vanishes(flags, care) && small;
  if ((flags & (has_handle | greedy)) != 0 && small) return true;
  return care == Care::boundary && buries_boundary(m, r, s, f);
}

bool stays_coarse(const Mesh& m, const u8* marks, u32 f) {
  for (u32 i = 0; i < 3; ++i)
    if (comes_from_marked(m, marks, taken_along | left_coarse, m.corner[3 * f + i])) return true;
  return false;
}

f64 squared_size(const Mesh& m, u32 f) {
  return max_of(squared_edge(m, 3 * f), max_of(squared_edge(m, 3 * f + 1), squared_edge(m, 3 * f + 2)));
}

// ---------------------------------------------------------------- components that lie upon each other

// Fewer vertices of the boundary than this are no loss to speak of: a fold, or the tip of something.
constexpr u32 least_loss = 16;

struct Sparing {
  const Mesh& m;
  Care care;
  Clusters& r;
  const SeamScratch& s;
  LostScratch& scratch;
};

// Would most of what the component shows go with this cluster, more than remains of it?
bool loses_most(Sparing& q, u32 cluster) {
  u32 lost = 0;
  for (u32 v : q.r.members) lost += q.s.winding[v] == 0 && find_cluster(q.r, v) == cluster ? 1 : 0;
  if (lost < least_loss) return false;
  collect_component(q.m, cluster, q.scratch.mark, q.scratch.vertices);
  u32 remaining = 0;
  for (u32 v : q.scratch.vertices) remaining += in_cluster(q.r, v) ? 0 : 1;
  return lost > remaining;
}

// The upper half of its bits: these are ordered as the numbers are.
u32 volume_of(Sparing& q, u32 v) {
  collect_component(q.m, v, q.scratch.mark, q.scratch.vertices);
  const f64 volume = abs_of(volume_of_component(q.m, q.scratch.vertices.span()).sum);
  return static_cast<u32>(__builtin_bit_cast(u64, volume) >> 32);
}

// Flags the clusters that are `at_stake`, and of those that meet each other the winner as `spared`, the other as
// `beaten`.
void choose_spared(Sparing& q, Span<const Contact> contacts) {
  u32* flags = q.r.number;
  u32* volume = q.r.group;  // of groups there is no need any more
  for (u32 v : q.r.members) {
    if (find_cluster(q.r, v) != v) continue;
    const bool whole = vanishes(flags[v], q.care);
    if (!whole && !(q.care == Care::boundary && (flags[v] & meets_other) != 0 && loses_most(q, v))) continue;
    flags[v] |= whole ? at_stake | spared : at_stake;
    volume[v] = volume_of(q, v);
  }
  for (const Contact& c : contacts) {
    const u32 a = cluster_of_face(q.m, q.r, c.a), b = cluster_of_face(q.m, q.r, c.b);
    if (a == b || (flags[a] & flags[b] & at_stake) == 0) continue;
    const bool a_wins = volume[a] > volume[b] || (volume[a] == volume[b] && a < b);
    flags[a_wins ? a : b] |= spared;
    flags[a_wins ? b : a] |= beaten;
  }
}

// All of the component joins the cluster, to go with it; or leaves the regions.
void take_whole_components(Sparing& q) {
  Clusters& r = q.r;
  const u32 members = r.members.size;
  for (u32 i = 0; i < members; ++i) {
    const u32 v = r.members[i];
    const u32 flags = find_cluster(r, v) == v ? r.number[v] : 0;
    if ((flags & beaten) == 0) continue;
    collect_component(q.m, v, q.scratch.mark, q.scratch.vertices);
    for (u32 u : q.scratch.vertices)
      if (!in_cluster(r, u)) {
        r.cluster[u] = v;
        r.members.push(u);
        r.number[u] = 0;
      }
  }
  for (u32 i = 0; i < members; ++i) r.group[r.members[i]] = r.number[find_cluster(r, r.members[i])];
  for (u32 i = 0; i < members; ++i) {
    const u32 v = r.members[i];
    if (!in_cluster(r, v) || (r.group[v] & (spared | beaten)) != spared) continue;
    collect_component(q.m, v, q.scratch.mark, q.scratch.vertices);
    for (u32 u : q.scratch.vertices) r.cluster[u] = none;
  }
}

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

void find_coarse(const Mesh& m, Span<const Contact> contacts, Care care, const u8* vertex_marks, const Clusters& r,
                 const SeamScratch& s, u8* mark, Stack<u32>& faces) {
  describe_clusters(m, contacts, r, s);
  if (care == Care::bulk) flag_greedy(m, r, s, mark, faces);
  faces.clear();
  const auto add = [&](u32 f) {
    if (mark[f] != 0 || stays_coarse(m, vertex_marks, f)) return;
    mark[f] = 1;
    faces.push(f);
  };
  for (const Contact& c : contacts) {
    const f64 a = squared_size(m, c.a), b = squared_size(m, c.b);
    const bool coarse = is_too_coarse(m, care, r, s, c.a) || is_too_coarse(m, care, r, s, c.b);
    const bool halve_a = coarse || a > most_squared_ratio * b, halve_b = coarse || b > most_squared_ratio * a;
    if (!(halve_a || halve_b) || !faces_cross(m, s, c.a, c.b)) continue;
    if (halve_a) add(c.a);
    if (halve_b) add(c.b);
  }
  for (u32 f : faces) mark[f] = 0;
}

u32 spare_largest(const Mesh& m, Span<const Contact> contacts, Care care, Clusters& r, const SeamScratch& s,
                  LostScratch& scratch) {
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
