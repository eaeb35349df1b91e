// SPDX-License-Identifier: MIT
#include "triangulate/front.h"

namespace tpa {

namespace {

void list_half_edges(Polygons& p, u32 face) {
  for (u32 h = 3 * face; h < 3 * face + 3; ++h) {
    u32& first = p.leaving[p.faces[face].v[h % 3]];
    p.after[h] = first;
    first = h;
  }
}

void unlist_half_edges(Polygons& p, u32 face) {
  for (u32 h = 3 * face; h < 3 * face + 3; ++h) {
    u32* link = &p.leaving[p.faces[face].v[h % 3]];
    while (*link != h) link = &p.after[*link];
    *link = p.after[h];
  }
}

void list_corner(Polygons& p, u32 corner) {
  u32& first = p.corner_at[p.corners[corner].vertex];
  p.corners[corner].same = first;
  first = corner;
}

// A corner of the polygon with fewer corners.
u32 in_smaller(const Polygons& p, u32 a, u32 b) {
  for (u32 i = a, k = b;;) {
    i = p.corners[i].next;
    k = p.corners[k].next;
    if (i == a) return a;
    if (k == b) return b;
  }
}

void number_polygon(Polygons& p, u32 corner, u32 number) {
  u32 c = corner;
  do {
    p.corners[c].polygon = number;
    c = p.corners[c].next;
  } while (c != corner);
}

// Is u to v an edge of an open polygon?
bool open_edge_exists(const Polygons& p, u32 u, u32 v) {
  u32 c = p.corner_at[u];
  while (c != none && p.corners[p.corners[c].next].vertex != v) c = p.corners[c].same;
  return c != none;
}

// Neighbours on a loop have their edge there, whether a face has been placed over it or not.
bool are_neighbours(const Polygons& p, u32 u, u32 v) {
  const u32 l = p.loop_of[u], apart = u < v ? v - u : u - v;
  return l == p.loop_of[v] && (apart == 1 || apart == p.loops[l].count - 1);
}

}  // namespace

void list_face(Polygons& p, const FaceCorners& face) {
  p.faces.push(face);
  list_half_edges(p, p.faces.size - 1);
}

void unlist_face(Polygons& p, u32 face) {
  unlist_half_edges(p, face);
  const u32 last = p.faces.size - 1;
  if (face != last) {
    unlist_half_edges(p, last);
    p.faces[face] = p.faces[last];
  }
  p.faces.pop();
  if (face != last) list_half_edges(p, face);
}

u32 placed_half_edge(const Polygons& p, u32 u, u32 v) {
  u32 h = p.leaving[u];
  while (h != none && p.faces[h / 3].v[(h + 1) % 3] != v) h = p.after[h];
  return h;
}

bool edge_exists(const Polygons& p, u32 u, u32 v) {
  return are_neighbours(p, u, v) || placed_half_edge(p, u, v) != none || placed_half_edge(p, v, u) != none ||
         open_edge_exists(p, u, v) || open_edge_exists(p, v, u);
}

bool has_room(const Polygons& p) { return p.closed > 0 || p.corners.size < p.corners.capacity; }

u32 new_corner(Polygons& p, u32 vertex) {
  u32 c = p.first_closed;
  if (c == none) {
    c = p.corners.size;
    p.corners.push({});
  } else {
    p.first_closed = p.corners[c].same;
    --p.closed;
  }
  p.corners[c] = {vertex, none, none, none, 1, none, none, 0, 0};
  list_corner(p, c);
  return c;
}

void free_corner(Polygons& p, u32 corner) {
  u32* link = &p.corner_at[p.corners[corner].vertex];
  while (*link != corner) link = &p.corners[*link].same;
  *link = p.corners[corner].same;
  p.corners[corner].stamp = none;
  p.corners[corner].same = p.first_closed;
  p.first_closed = corner;
  ++p.closed;
}

void begin(Polygons& p) {
  for (u32 v = 0; v < p.points.count; ++v) p.leaving[v] = p.corner_at[v] = none;
  for (u32 l = 0, first = 0; l < p.loops.size; first += p.loops[l++].count) {
    const u32 n = p.loops[l].count;
    for (u32 i = 0; i < n; ++i) p.loop_of[first + i] = l;
    for (u32 i = 0; i < n; ++i) p.corners[new_corner(p, first + i)].stamp = 0;
    for (u32 i = 0; i < n; ++i) connect(p, first + i, first + (i + 1) % n);
    number_polygon(p, first, p.numbers++);
  }
}

void splice(Polygons& p, u32 c, u32 apex) {
  const bool parts = p.corners[c].polygon == p.corners[apex].polygon;
  if (!parts) {
    const u32 smaller = in_smaller(p, c, apex);
    number_polygon(p, smaller, p.corners[smaller == c ? apex : c].polygon);
  }
  const u32 after = p.corners[c].next;
  const Corner b = p.corners[apex];
  const u32 again = new_corner(p, b.vertex);
  connect(p, again, b.next);
  connect(p, c, again);
  connect(p, apex, after);
  p.corners[again].polygon = p.corners[c].polygon;
  if (parts) number_polygon(p, in_smaller(p, c, apex), p.numbers++);
}

void drop_edge(Polygons& p, u32 c) {
  for (;;) {
    const u32 after = p.corners[c].next;
    const auto is_other_side = [&](u32 d) {
      return p.corners[p.corners[d].next].vertex == p.corners[c].vertex &&
             (d == after || p.corners[d].polygon != p.corners[c].polygon);
    };
    u32 d = p.corner_at[p.corners[after].vertex];
    while (d != none && !is_other_side(d)) d = p.corners[d].same;
    if (d == none) return;
    const u32 back = p.corners[d].next;
    if (d != after) {
      const u32 smaller = in_smaller(p, c, d);
      number_polygon(p, smaller, p.corners[smaller == c ? d : c].polygon);
      connect(p, c, p.corners[back].next);
      connect(p, d, p.corners[after].next);
      free_corner(p, after);
      free_corner(p, back);
      return;
    }
    connect(p, c, p.corners[back].next);
    free_corner(p, after);
    free_corner(p, back);
    if (back == c) return;
  }
}

}  // namespace tpa
