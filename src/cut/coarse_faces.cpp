// SPDX-License-Identifier: MIT
#include "cut/coarse_faces.h"

#include "edit/bisect.h"

namespace tpa {

namespace {

// The larger of two faces in contact is halved if its longest edge is more than four times as long as the longest edge
// of the smaller. Else the hole would be much larger than the part that comes through.
constexpr f64 most_squared_ratio = 16;

// A component of more vertices, all in contact, is not coarse, but lies upon another.
constexpr u32 most_coarse_vertices = 512;

// Euler's number of a cluster, vertices less edges plus faces, is 2, less 1 for each loop and 2 for each handle.
// Clusters that meet others do not matter.
void flag_handles(const Mesh& m, const Clusters& r) {
  i32* euler = r.euler;
  for (u32 v : r.members) euler[v] = 0;
  for (u32 v : r.members) {
    const u32 cluster = find_cluster(r, v);
    if ((r.traits[cluster] & meets_other) != 0) continue;
    i32& own = euler[cluster];
    ++own;
    for_each_outgoing(m, v, [&](u32 h) {
      if (!in_cluster(r, head(m, h))) return;
      const bool counts_edge = h < m.opposite[h], counts_face = index_in_face(h) == 0;
      if (counts_edge) --own;
      if (counts_face && in_cluster(r, apex(m, h))) ++own;
    });
  }
  for (const CutLoop& loop : r.loops) ++euler[loop.cluster];
  for (u32 v : r.members)
    if (find_cluster(r, v) == v && (r.traits[v] & meets_other) == 0 && euler[v] < 2) r.traits[v] |= has_handle;
}

void describe_clusters(const Mesh& m, Span<const Contact> contacts, const Clusters& r, const SeamScratch& s) {
  u32* flags = r.traits;
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

// Does the cluster of this loop take much along: is the area of the rest less than least_left times the visible area of
// the going faces? Hardly more of the rest is visited. `mark` and `faces`: as for find_coarse_faces().
constexpr f64 least_left = 2;
bool takes_much(const Mesh& m, const Clusters& r, const SeamScratch& s, const CutLoop& loop, u8* mark,
                Stack<u32>& faces) {
  // Winding numbers outside the clusters are unknown, and take no part.
  const auto is_hidden = [&](u32 v) { return in_cluster(r, v) & (s.winding[v] != 0); };
  // New faces are as good as random: without a branch, a face beyond the end may be written.
  const auto add = [&](u32 f, bool wanted) {
    const bool is_new = (mark[f] == 0) & wanted;
    faces.data[faces.size] = f;
    faces.size += is_new ? 1u : 0u;
    mark[f] = static_cast<u8>(mark[f] | is_new);
  };
  faces.clear();
  add(face_of(r.cuts[loop.first].half_edge), true);
  f64 area = 0;
  // A face goes with any of its corners.
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
  // All going faces round this cluster are marked by now. Going faces of other clusters, beside staying faces, have
  // their apex in a cluster.
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
    u32& flags = r.traits[loop.cluster];
    if ((flags & weighed) != 0) continue;
    flags |= weighed;
    if (takes_much(m, r, s, loop, mark, faces)) flags |= greedy;
  }
}

// Has the face a vertex of the boundary with all neighbours in clusters? More than a rim would go with that vertex.
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
  const u32 flags = r.traits[cluster_of_face(m, r, f)];
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

}  // namespace

bool vanishes(u32 traits, Care care) {
  return (traits & (has_loop | bounds)) == bounds && (care == Care::boundary || (traits & meets_other) != 0);
}

void find_coarse_faces(const Mesh& m, Span<const Contact> contacts, Care care, const u8* vertex_marks,
                       const Clusters& r, const SeamScratch& s, u8* mark, Stack<u32>& faces) {
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

}  // namespace tpa
