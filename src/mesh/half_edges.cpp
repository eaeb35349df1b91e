// SPDX-License-Identifier: MIT
#include "mesh/half_edges.h"

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

u32 lesser_end(const Mesh& m, u32 h) { return min_of(tail(m, h), head(m, h)); }
u32 greater_end(const Mesh& m, u32 h) { return max_of(tail(m, h), head(m, h)); }

// Writes half-edges ordered by one of their ends, those of one vertex in the order of in(0), in(1) and so on. `place`
// has vertex_count + 1 entries.
template <class In, class EndOf>
void order_by_end(const Mesh& m, u32* place, In in, EndOf end_of, u32* out) {
  const u32 half_edges = 3 * m.face_count;
  for (u32 v = 0; v <= m.vertex_count; ++v) place[v] = 0;
  for (u32 h = 0; h < half_edges; ++h) ++place[end_of(m, h) + 1];
  for (u32 v = 0; v < m.vertex_count; ++v) place[v + 1] += place[v];
  for (u32 i = 0; i < half_edges; ++i) {
    const u32 h = in(i);
    out[place[end_of(m, h)]++] = h;
  }
}

// By lower end, then by upper end, then by number: the half-edges of an edge follow each other, the lowest first.
// `spare` has room for all.
void order_by_edge(const Mesh& m, u32* place, u32* spare, u32* edges) {
  order_by_end(
      m, place, [](u32 i) { return i; }, greater_end, spare);
  order_by_end(
      m, place, [&](u32 i) { return spare[i]; }, lesser_end, edges);
}

// The defect of an edge with several half-edges, or one; 0 for a good one.
i32 defect_of_edge(const Mesh& m, const u32* edges, u32 count) {
  if (count > 2) return non_manifold_edge;
  if (count == 1) return boundary_edge;
  return tail(m, edges[0]) == tail(m, edges[1]) ? i32{orientation} : 0;
}

// Of several outgoing half-edges of a vertex, vertex_edge is the one with the lowest head: the first in the order.
void note_outgoing(Mesh& m, u32 h) {
  u32& first = m.vertex_edge[tail(m, h)];
  if (first == none) first = h;
}

// Pairs every half-edge with its opposite. A defect names the edge in the direction of its first half-edge.
Defect pair_edges(Mesh& m, const u32* edges) {
  u32 first[3] = {none, none, none};  // half-edges, by severity: orientation, more than two triangles, boundary
  const u32 half_edges = 3 * m.face_count;
  for (u32 v = 0; v < m.vertex_count; ++v) m.vertex_edge[v] = none;
  for (u32 i = 0, end = 0; i < half_edges; i = end) {
    const u32 g = edges[i], low = lesser_end(m, g), up = greater_end(m, g);
    for (end = i + 1; end < half_edges && greater_end(m, edges[end]) == up && lesser_end(m, edges[end]) == low;) ++end;
    if (const i32 kind = defect_of_edge(m, edges + i, end - i); kind != 0) {
      u32& lowest = first[kind - orientation];
      lowest = min_of(lowest, g);
      continue;
    }
    const u32 h = edges[i + 1];
    m.opposite[g] = h;
    m.opposite[h] = g;
    note_outgoing(m, g);
    note_outgoing(m, h);
  }
  for (i32 i = 0; i < 3; ++i)
    if (first[i] != none) return {orientation + i, tail(m, first[i]), head(m, first[i])};
  return {};
}

// The first vertex with outgoing half-edges that a walk round it does not meet; there is one.
u32 first_of_several_fans(const Mesh& m, u32* outgoing) {
  for (u32 v = 0; v < m.vertex_count; ++v) outgoing[v] = 0;
  for (u32 h = 0; h < 3 * m.face_count; ++h) ++outgoing[tail(m, h)];
  u32 v = 0;
  while (m.vertex_edge[v] == none || valence(m, v) == outgoing[v]) ++v;
  return v;
}

// Walks round all vertices must meet all half-edges.
Defect check_fans(const Mesh& m, u32* outgoing) {
  u32 isolated = none, met = 0;
  for (u32 v = 0; v < m.vertex_count; ++v)
    if (m.vertex_edge[v] != none)
      met += valence(m, v);
    else
      isolated = min_of(isolated, v);
  if (met != 3 * m.face_count) return {non_manifold_vertex, first_of_several_fans(m, outgoing), 0};
  if (isolated != none) return {isolated_vertex, isolated, 0};
  return {};
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

Defect connect(Mesh& m, u32* per_vertex, u32* edges) {
  for (u32 f = 0; f < m.face_count; ++f) {
    const u32* c = m.corner + 3 * f;
    if (c[0] == c[1] || c[0] == c[2]) return {repeated_vertex, f, c[0]};
    if (c[1] == c[2]) return {repeated_vertex, f, c[1]};
  }
  order_by_edge(m, per_vertex, m.opposite, edges);
  const Defect d = pair_edges(m, edges);
  return d.kind != 0 ? d : check_fans(m, per_vertex);
}

}  // namespace tpa
