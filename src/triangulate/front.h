// SPDX-License-Identifier: MIT
// front: the open rest while loops are closed face by face. Faces placed so far are listed by the half-edges that leave
// each vertex; open polygons are rings of corners, which are parted and joined.
#pragma once

#include "geometry/kd_tree.h"
#include "triangulate/candidates.h"

namespace tpa {

// A corner of a polygon. A vertex has one more corner for each face that joins or parts polygons there.
struct Corner {
  u32 vertex;
  u32 previous, next;
  u32 polygon;
  u32 stamp;  // names the edge to `next`; 0 before any face is placed here, none once the corner is closed
  u32 same;   // another open corner at the vertex; for a closed corner, another closed corner
  // Of the edge to `next`: apex and weight of the face considered, and the number of faces tried.
  u32 apex, tries;
  f64 weight;
};

struct Polygons {
  Span<const Loop> loops;
  KdTree points;  // of all vertices
  Stack<Corner> corners;
  Stack<FaceCorners> faces;  // placed; half-edge 3 f + i leaves corner i of face f
  u32 *leaving, *after;      // per vertex: the first half-edge from it; per half-edge: the next from the same vertex
  u32* corner_at;            // per vertex: the first corner
  u32* loop_of;              // per vertex
  u32 first_closed = none;   // of the closed corners
  u32 closed = 0;            // number of closed corners
  u32 numbers = 0;           // given to polygons so far

  const Vec3& point(u32 corner) const { return points.point[corners[corner].vertex]; }
  bool is_open(u32 corner) const { return corners[corner].stamp != none; }
};

// Lists a placed face.
void list_face(Polygons& p, const FaceCorners& face);
// Takes a face from the list; the last face gets its number.
void unlist_face(Polygons& p, u32 face);
// The placed half-edge from u to v; none at a loop, and where both sides are open.
u32 placed_half_edge(const Polygons& p, u32 u, u32 v);
// Does the surface so far have this edge, on either side?
bool edge_exists(const Polygons& p, u32 u, u32 v);

bool has_room(const Polygons& p);
// A corner at a vertex, not linked yet. Pre: has_room().
u32 new_corner(Polygons& p, u32 vertex);
void free_corner(Polygons& p, u32 corner);
inline void connect(Polygons& p, u32 from, u32 to) {
  p.corners[from].next = to;
  p.corners[to].previous = from;
}

// Each loop is a polygon.
void begin(Polygons& p);

// Brings the polygons up to date after a face over the edge from c. An apex b in the same polygon parts it: ... c, c'
// ... b ... becomes ... c, b again ... and c' ... b. An apex in another polygon joins both: ... c, b again ... b, c'
// ...
void splice(Polygons& p, u32 c, u32 apex);

// Removes the edge from c where its other side is open too, at the next edge or in another polygon; two polygons become
// one. Within one polygon the edge may hold two parts of its rim together, and stays.
void drop_edge(Polygons& p, u32 c);

}  // namespace tpa
