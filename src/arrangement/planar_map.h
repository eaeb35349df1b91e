// SPDX-License-Identifier: MIT
// planar_map: a triangulation of points in a plane, with edges that must stay: the sides of the plane's faces and the
// traces of others. The convex hull of the points is filled.
#pragma once

#include "arrangement/points.h"

namespace tpa {

// Something that lies in the plane of a face: the stretch from p to q cut by the plane `other`, or a point alone, with
// p == q.
struct Trace {
  u32 place;  // of the face in Arrangement::faces
  PlaneRef other;
  u32 p, q;
};

// Half-edges as in mesh/half_edges.h; a vertex is a place in `vertex`.
struct PlanarMap {
  ArrangementPoints* points = nullptr;
  PlaneRef plane = {};
  u32 axis = 0;            // the plane is seen along this axis
  Stack<u32> vertex;       // points
  u32* leaving = nullptr;  // per vertex: a half-edge; on the hull the hull's own
  u32* after = nullptr;    // per vertex on the hull: the next, counter-clockwise
  u32* before = nullptr;
  Stack<u32> corner;  // three for each triangle
  u32* opposite = nullptr;
  u32* trace = nullptr;  // per half-edge: number of the trace that keeps the edge, or none
  u8* mark = nullptr;    // per triangle: zero between operations
  Stack<u32> work;
  u32 most_work = 0;           // words of `work` that a segment needed
  bool contradiction = false;  // never expected: a segment leads nowhere
};

inline u32 triangle_count(const PlanarMap& m) { return m.corner.size / 3; }
inline int turn(const PlanarMap& m, u32 i, u32 j, u32 k) {
  return turn(*m.points, m.axis, m.vertex[i], m.vertex[j], m.vertex[k]);
}

// Calls visit(h) for each half-edge from v, counter-clockwise, until an answer is true; returns that half-edge, or
// none.
template <class Visit>
u32 find_leaving(const PlanarMap& m, u32 v, Visit visit) {
  const u32 first = m.leaving[v];
  u32 h = first;
  do {
    if (visit(h)) return h;
    h = m.opposite[previous_edge(h)];
  } while (h != none && h != first);
  return none;
}

inline void link(PlanarMap& m, u32 g, u32 h) {
  m.opposite[g] = h;
  if (h != none) m.opposite[h] = g;
}
// Without neighbours and traces yet. Returns the first half-edge, from a to b. Pre: there is room.
u32 add_triangle(PlanarMap& m, u32 a, u32 b, u32 c);
// After the corners of triangle t have changed.
void note_leaving(PlanarMap& m, u32 t);

// Triangulates the points of m.vertex, at least three and not all on a line, in the order of a sweep (Sedgewick 1983).
// O(n log n), and O(n) turns for each hull edge that goes. Incomplete if the meter of the points stops.
void triangulate(PlanarMap& m);

// Flips edges, but for kept ones, towards a Delaunay triangulation (Lawson 1977), by rounded coordinates. Exact turns
// keep the map valid.
void make_even(PlanarMap& m);

// The half-edge that leaves vertex p along the segment to vertex q, with its triangle on the left; none if the segment
// is no edge there.
u32 edge_towards(const PlanarMap& m, u32 p, u32 q);

// Keeps the segment from vertex p to vertex q, as part of the trace of number `number`. Where the segment crosses a
// kept edge, the crossing becomes a vertex of the map. False if points run out, or the meter stops.
bool keep_segment(PlanarMap& m, u32 p, u32 q, u32 number, Span<const Trace> traces);

}  // namespace tpa
