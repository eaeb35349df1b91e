// SPDX-License-Identifier: MIT
#include "mesh/half_edges.h"

#include "base/sort.h"

namespace tpa {

namespace {

enum : i32 {
  repeated_vertex = 4,
  orientation = 5,
  non_manifold_edge = 6,
  boundary_edge = 7,
  non_manifold_vertex = 8,
  isolated_vertex = 9
};

// Buckets the half-edges by tail: edges[start[v] .. start[v + 1] - 1] leave v, sorted by head. O(V log V), by the sort,
// even if one vertex has most of the edges.
void bucket_by_tail(const Mesh& m, u32* start, u32* edges) {
  const u32 n = m.vertex_count, half_edges = 3 * m.face_count;
  for (u32 v = 0; v <= n; ++v) start[v] = 0;
  for (u32 h = 0; h < half_edges; ++h) ++start[m.corner[h]];
  u32 sum = 0;
  for (u32 v = 0; v <= n; ++v) {
    const u32 count = start[v];
    start[v] = sum;
    sum += count;
  }
  for (u32 h = 0; h < half_edges; ++h) edges[start[m.corner[h]]++] = h;
  for (u32 v = n; v > 0; --v) start[v] = start[v - 1];
  start[0] = 0;
  for (u32 v = 0; v < n; ++v)
    sort_in_place(edges + start[v], start[v + 1] - start[v],
                  [&](u32 g, u32 h) { return head(m, g) != head(m, h) ? head(m, g) < head(m, h) : g < h; });
}

// Counts the half-edges between two vertices, in one direction; `found` is the last.
u32 count_edges(const Mesh& m, const u32* start, const u32* edges, u32 from, u32 to, u32& found) {
  u32 lo = start[from], hi = start[from + 1];
  while (lo < hi) {
    const u32 middle = lo + (hi - lo) / 2;
    if (head(m, edges[middle]) < to)
      lo = middle + 1;
    else
      hi = middle;
  }
  u32 count = 0;
  for (; lo < start[from + 1] && head(m, edges[lo]) == to; ++lo, ++count) found = edges[lo];
  return count;
}

// Pairs every half-edge with its opposite. A defect names the edge in the direction of its first half-edge.
Defect pair_edges(Mesh& m, const u32* start, const u32* edges) {
  Defect first[3];  // by severity: orientation, more than two triangles, boundary
  for (u32 h = 0; h < 3 * m.face_count; ++h) m.opposite[h] = none;
  for (u32 h = 0; h < 3 * m.face_count; ++h) {
    if (m.opposite[h] != none) continue;  // paired from the other side
    const u32 a = tail(m, h), b = head(m, h);
    u32 same = none, other = none;
    const u32 forth = count_edges(m, start, edges, a, b, same);
    const u32 back = count_edges(m, start, edges, b, a, other);
    const i32 kind = forth + back > 2 ? non_manifold_edge
                     : forth == 2     ? orientation
                     : back == 0      ? i32{boundary_edge}
                                      : 0;
    if (kind == 0) {
      m.opposite[h] = other;
      m.opposite[other] = h;
    } else if (first[kind - orientation].kind == 0) {
      first[kind - orientation] = {kind, a, b};
    }
  }
  for (const Defect& d : first)
    if (d.kind != 0) return d;
  return {};
}

// A walk round each vertex must meet all of its outgoing half-edges.
Defect check_fans(Mesh& m, const u32* start, const u32* edges) {
  Defect isolated;
  for (u32 v = 0; v < m.vertex_count; ++v) {
    const u32 count = start[v + 1] - start[v];
    if (count == 0) {
      m.vertex_edge[v] = none;
      if (isolated.kind == 0) isolated = {isolated_vertex, v, 0};
      continue;
    }
    m.vertex_edge[v] = edges[start[v]];
    if (valence(m, v) != count) return {non_manifold_vertex, v, 0};
  }
  return isolated;
}

}  // namespace

u32 common_corner(const Mesh& m, Span<const u32> faces) {
  u32 left[3], count = 0;
  for (u32 i = 0; i < faces.size; ++i) {
    const u32* v = m.corner + 3 * static_cast<size_t>(faces[i]);
    if (i == 0) {
      for (; count < 3; ++count) left[count] = v[count];
      continue;
    }
    u32 kept = 0;
    for (u32 k = 0; k < count; ++k)
      if (left[k] == v[0] || left[k] == v[1] || left[k] == v[2]) left[kept++] = left[k];
    count = kept;
    if (count == 0) return none;
  }
  return count > 0 ? left[0] : none;
}

u32 find_edge(const Mesh& m, u32 a, u32 b) {
  // Round both vertices in step.
  const u32 first_a = m.vertex_edge[a], first_b = m.vertex_edge[b];
  for (u32 g = first_a, h = first_b;;) {
    if (head(m, g) == b) return g;
    if (head(m, h) == a) return m.opposite[h];
    g = rotate(m, g);
    h = rotate(m, h);
    if (g == first_a || h == first_b) return none;
  }
}

Defect connect(Mesh& m, u32* head_slot, u32* edges) {
  for (u32 f = 0; f < m.face_count; ++f) {
    const u32* c = m.corner + 3 * f;
    if (c[0] == c[1] || c[0] == c[2]) return {repeated_vertex, f, c[0]};
    if (c[1] == c[2]) return {repeated_vertex, f, c[1]};
  }
  bucket_by_tail(m, head_slot, edges);
  const Defect d = pair_edges(m, head_slot, edges);
  return d.kind != 0 ? d : check_fans(m, head_slot, edges);
}

}  // namespace tpa
