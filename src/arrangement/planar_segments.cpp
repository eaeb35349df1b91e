// SPDX-License-Identifier: MIT
// The part of planar_map that keeps segments. The triangles that a segment crosses make way for new ones on both of its
// sides.
#include "arrangement/known_lines.h"
#include "arrangement/planar_map.h"

namespace tpa {

namespace {

// Divides the edge h at vertex x.
void split_edge(PlanarMap& m, u32 h, u32 x) {
  const u32 g = m.opposite[h], kept = m.trace[h];
  // Triangle (a, b, c) of e becomes (a, x, c), in place, and (x, b, c). Returns the half-edge from x to b.
  const auto halve = [&](u32 e) {
    const u32 far_edge = next_edge(e), b = m.corner[far_edge], c = m.corner[previous_edge(e)];
    const u32 half = add_triangle(m, x, b, c);
    link(m, half + 1, m.opposite[far_edge]);
    m.trace[half + 1] = m.trace[far_edge];
    m.corner[far_edge] = x;
    link(m, far_edge, half + 2);
    m.trace[far_edge] = none;
    m.trace[e] = m.trace[half] = kept;
    if (m.leaving[b] == far_edge) m.leaving[b] = half + 1;
    return half;
  };
  const u32 h_half = halve(h);
  m.leaving[x] = h_half;
  if (g == none) return;
  const u32 g_half = halve(g);
  link(m, h, g_half);
  link(m, h_half, g);
}

// The first element on the way from p to q.
struct Way {
  u32 edge = none;     // on the segment, or across from p in the triangle that the segment enters
  u32 reached = none;  // the vertex at the other end of an edge on the segment
};

// x lies on the line through p and q: on the side of q?
bool is_ahead(const PlanarMap& m, u32 p, u32 q, u32 x) {
  for (u32 axis = 0; axis < 3; ++axis) {
    const int to_q = axis == m.axis ? 0 : compare_along(*m.points, axis, m.vertex[q], m.vertex[p]);
    if (to_q != 0) return compare_along(*m.points, axis, m.vertex[x], m.vertex[p]) == to_q;
  }
  return false;
}

// The segment from p to q, cut by a plane.
struct Segment {
  u32 p, q;
  PlaneRef plane;
};

// The side of vertex x about the segment. Most zeros are known without arithmetic.
int side_of(const PlanarMap& m, const Segment& s, u32 x) {
  if (x == s.q || comes_from_plane(*m.points->mesh, m.points->list[m.vertex[x]], s.plane)) return 0;
  return turn(m, s.p, s.q, x);
}

Way way_from(const PlanarMap& m, const Segment& s) {
  const u32 p = s.p, q = s.q;
  Way way;
  find_leaving(m, p, [&](u32 h) {
    const u32 x = m.corner[next_edge(h)], y = m.corner[previous_edge(h)];
    const int side_x = side_of(m, s, x), side_y = side_of(m, s, y);
    if (side_x == 0 && is_ahead(m, p, q, x))
      way = {h, x};
    else if (side_y == 0 && is_ahead(m, p, q, y))
      way = {previous_edge(h), y};
    else if (side_x < 0 && side_y > 0)
      way = {next_edge(h), none};
    return way.edge != none;
  });
  return way;
}

void keep_edge(PlanarMap& m, u32 h, u32 number) {
  if (m.trace[h] == none) m.trace[h] = number;
  if (m.opposite[h] != none) m.trace[m.opposite[h]] = m.trace[h];
}

// Walks from p through the triangles that the segment crosses, beginning with the triangle of `across`. Calls
// visit(g, x, side) for each further triangle: entered through g, with the third vertex x on that side of the segment.
// Ends at a vertex on the segment, returned, or at a kept edge, `stop`.
template <class Visit>
u32 walk_across(const PlanarMap& m, const Segment& s, u32 across, u32& stop, Visit visit) {
  for (;;) {
    stop = m.trace[across] != none ? across : none;
    if (stop != none) return none;
    const u32 g = m.opposite[across], x = m.corner[previous_edge(g)];
    const int side = side_of(m, s, x);
    visit(g, x, side);
    if (side == 0) return x;
    across = side > 0 ? next_edge(g) : previous_edge(g);
  }
}

// ---------------------------------------------------------------- the cavity

// A side of the cavity in m.work: one entry for each vertex. The fields describe the edge to the vertex of the next
// entry.
struct SideEntry {
  u32 vertex;
  u32 old, inner, beyond;  // half-edges: inside before and after the filling, and on the other side
  u32 trace;
};
struct Side {
  SideEntry* entry;
  u32 count;
};

// Fills the space between a side and the segment from its first vertex to its last, on the left of the segment. Every
// vertex of the side sees the segment, in the order of the side. So every vertex with less than half a turn inside may
// be cut off: no other vertex can lie in its triangle. next_slot() hands out triangles; inner half-edges are noted.
// Returns the half-edge along the segment.
template <class NextSlot>
u32 fill(PlanarMap& m, const Side& s, NextSlot next_slot) {
  struct Open {
    u32 at, chord;  // an entry; instead of its edge, the half-edge of a triangle that cut vertices off, or none
  };
  Open* const open = reinterpret_cast<Open*>(m.work.data + m.work.size);
  u32 count = 0;
  const auto vertex = [&](u32 i) { return s.entry[open[i].at].vertex; };
  const auto close = [&](const Open& o, u32 inner) {
    if (o.chord != none)
      link(m, o.chord, inner);
    else
      s.entry[o.at].inner = inner;
  };
  for (u32 k = 0; k < s.count; ++k) {
    const u32 w = s.entry[k].vertex;
    while (count >= 2 && turn(m, vertex(count - 2), vertex(count - 1), w) < 0) {
      const u32 h = next_slot();
      m.corner[h] = vertex(count - 2), m.corner[h + 1] = w, m.corner[h + 2] = vertex(count - 1);
      for (u32 e = h; e < h + 3; ++e) m.opposite[e] = m.trace[e] = none;
      close(open[count - 2], h + 2);
      close(open[count - 1], h + 1);
      open[--count - 1].chord = h;
    }
    open[count++] = {k, none};
  }
  return open[0].chord;
}

// Sews the filling to the edge of a side. Where both triangles beside the edge went, the edge is in the sides twice.
void sew(PlanarMap& m, const SideEntry& e, const Side (&sides)[2]) {
  u32 beyond = e.beyond;
  if (beyond != none && m.mark[face_of(beyond)] != 0)
    for (const Side& s : sides) {
      spend(m.points->meter, s.count / 8);
      for (u32 i = 0; i + 1 < s.count; ++i)
        if (s.entry[i].old == e.beyond) beyond = s.entry[i].inner;
    }
  link(m, e.inner, beyond);
  m.trace[e.inner] = e.trace;
}

constexpr u32 words_of_entry = sizeof(SideEntry) / sizeof(u32);

// Makes an edge of a free stretch that enters the triangle of `across` first. False if scratch runs
// out.
bool open_and_fill(PlanarMap& m, const Segment& stretch, u32 across, u32 number) {
  const u32 p = stretch.p, end = stretch.q;
  u32 stop = none, crossed = 1, upper = 2, lower = 2;
  walk_across(m, stretch, across, stop, [&](u32, u32, int side) {
    ++crossed;
    upper += side > 0 ? 1u : 0u;
    lower += side < 0 ? 1u : 0u;
  });
  // The triangles, the entries, and the open vertices of fill().
  const u32 entries = (upper + 1) + (lower + 1);
  const u64 words = crossed + u64{words_of_entry + 2} * entries;
  if (words > m.work.capacity) return false;
  m.most_work = max_of(m.most_work, static_cast<u32>(words));
  u32* const slots = m.work.data;
  SideEntry* const entry = reinterpret_cast<SideEntry*>(slots + crossed);
  const Side sides[2] = {{entry, upper + 1}, {entry + upper + 1, lower + 1}};
  const auto edge_entry = [&](u32 vertex, u32 inner) {
    return SideEntry{vertex, inner, none, m.opposite[inner], m.trace[inner]};
  };
  const u32 to_p = next_edge(across), from_p = previous_edge(across);
  // The upper side runs from p to the end, the lower side back.
  u32 at_upper = 0, at_lower = lower, at_slot = 0;
  slots[at_slot++] = face_of(across);
  sides[0].entry[at_upper] = edge_entry(p, to_p);
  u32 above = m.corner[to_p], below = m.corner[across];
  sides[1].entry[at_lower] = {p, none, none, none, none};
  sides[1].entry[--at_lower] = edge_entry(below, from_p);
  walk_across(m, stretch, across, stop, [&](u32 g, u32 x, int side) {
    slots[at_slot++] = face_of(g);
    if (side >= 0) {
      sides[0].entry[++at_upper] = edge_entry(above, previous_edge(g));
      above = x;
    }
    if (side <= 0) {
      sides[1].entry[--at_lower] = edge_entry(x, next_edge(g));
      below = x;
    }
  });
  sides[0].entry[++at_upper] = {end, none, none, none, none};
  for (u32 i = 0; i < crossed; ++i) m.mark[slots[i]] = 1;
  m.work.size = crossed + words_of_entry * entries;
  u32 next = 0;
  const auto next_slot = [&] { return 3 * slots[next++]; };
  const u32 forth = fill(m, sides[0], next_slot), back = fill(m, sides[1], next_slot);
  for (const Side& s : sides)
    for (u32 i = 0; i + 1 < s.count; ++i) sew(m, s.entry[i], sides);
  for (u32 i = 0; i < crossed; ++i) m.mark[slots[i]] = 0;
  link(m, forth, back);
  m.trace[forth] = m.trace[back] = number;
  for (u32 i = 0; i < crossed; ++i) note_leaving(m, slots[i]);
  m.work.clear();
  return true;
}

// Divides a kept edge where a trace crosses it.
bool divide(PlanarMap& m, u32 edge, const Trace& crossing, Span<const Trace> traces) {
  const u32 point = add_plane_crossing(*m.points, m.plane, crossing.other, traces[m.trace[edge]].other);
  if (point == none || !m.vertex.push(point)) return false;
  split_edge(m, edge, m.vertex.size - 1);
  return true;
}

}  // namespace

u32 edge_towards(const PlanarMap& m, u32 p, u32 q) {
  return find_leaving(m, p, [&](u32 h) {
    const u32 x = m.corner[next_edge(h)];
    return x == q || (turn(m, p, q, x) == 0 && is_ahead(m, p, q, x));
  });
}

bool keep_segment(PlanarMap& m, u32 p, u32 q, u32 number, Span<const Trace> traces) {
  while (p != q) {
    if (has_stopped(m.points->meter)) return false;
    const Segment rest{p, q, traces[number].other};
    const Way way = way_from(m, rest);
    if (way.edge == none) {
      m.contradiction = true;
      return false;
    }
    if (way.reached != none) {
      keep_edge(m, way.edge, number);
      p = way.reached;
      continue;
    }
    u32 stop = none;
    const u32 end = walk_across(m, rest, way.edge, stop, [](u32, u32, int) {});
    if (end == none) {
      if (!divide(m, stop, traces[number], traces)) return false;
    } else {
      if (!open_and_fill(m, {p, end, rest.plane}, way.edge, number)) return false;
      p = end;
    }
  }
  return true;
}

}  // namespace tpa
