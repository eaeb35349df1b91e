// front: what is open while loops are closed face by face. The faces placed so far, by the half-edges that leave
// each vertex, and the polygons that are left, as rings of corners that are parted and joined.
#pragma once

#include "geometry/kd_tree.h"
#include "triangulate/candidates.h"

namespace tpa {

// A corner of a polygon. A vertex has one more for each face that joins or parts polygons there.
struct Corner {
  u32 vertex;
  u32 previous, next;
  u32 polygon;
  u32 stamp;  // names the edge to `next`; 0: no face has been placed here, none: the corner is closed
  u32 same;   // another open corner at the vertex; of a closed one: another closed one
  // Of the edge to `next`: the face that is considered, and how many have been.
  u32 apex, tries;
  f64 weight;
};

struct Polygons {
  Span<const Loop> loops;
  PointTree points;  // of all vertices
  Stack<Corner> corners;
  Stack<FaceCorners> faces;  // placed; half-edge 3 f + i leaves corner i of face f
  u32 *leaving, *after;      // per vertex: the first half-edge that leaves it; per half-edge: another that does
  u32* corner_at;            // per vertex: the first corner
  u32* loop_of;              // per vertex
  u32 first_closed = none;   // of the corners that are closed
  u32 closed = 0;            // how many
  u32 numbers = 0;           // given to polygons

  const Vec3& point(u32 corner) const { return points.point[corners[corner].vertex]; }
  bool is_open(u32 corner) const { return corners[corner].stamp != none; }
};

// Of faces that the caller places.
void list_face(Polygons& p, const FaceCorners& face);
// The last face gets its number.
void unlist_face(Polygons& p, u32 face);
// The placed half-edge from u to v; none at a loop, and where both sides are open.
u32 placed_half_edge(const Polygons& p, u32 u, u32 v);
// In the surface so far, on either side.
bool edge_exists(const Polygons& p, u32 u, u32 v);

bool has_room(const Polygons& p);
// A corner at a vertex, linked to nothing yet.
// Pre: has_room().
u32 new_corner(Polygons& p, u32 vertex);
void free_corner(Polygons& p, u32 corner);
inline void connect(Polygons& p, u32 from, u32 to) {
  p.corners[from].next = to;
  p.corners[to].previous = from;
}

// Each loop is a polygon.
void begin(Polygons& p);

// A face over the edge from c, with its apex in the same polygon, parts that: ... c, c' ... b ... becomes
// ... c, b again ... and c' ... b; in another one it joins them: ... c, b again ... b, c' ...
void splice(Polygons& p, u32 c, u32 apex);

// The edge from c goes where it is open on its other side too, and there is the next one, or another polygon, which
// becomes one with this. Within one polygon an edge may be what holds two parts of its rim together.
void drop_edge(Polygons& p, u32 c);

// Is the way round the corner's polygon longer than this?
bool is_longer(const Polygons& p, u32 corner, f64 limit);

// Are two vertices of a loop farther from each other along it than this, both ways round?
bool is_farther_along_loop(const Polygons& p, u32 u, u32 v, f64 limit);

}  // namespace tpa
