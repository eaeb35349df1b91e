// SPDX-License-Identifier: MIT
// points: the vertices of an arrangement, each known by the elements of the mesh that make it, and exact questions
// about them. Equal points are one. Coordinates rounded to nearest serve as filter, and as positions afterwards.
#pragma once

#include "base/meter.h"
#include "base/open_hash.h"
#include "geometry/constructed_point.h"
#include "geometry/near_point.h"
#include "geometry/predicates.h"
#include "mesh/half_edges.h"

namespace tpa {

// A plane by an element of the mesh: of the face `id`, or through the half-edge `id` along a coordinate axis.
struct PlaneRef {
  u32 id;
  u32 axis;
};
constexpr bool operator==(const PlaneRef& p, const PlaneRef& q) { return p.id == q.id && p.axis == q.axis; }
inline constexpr u32 of_face = 3;  // in place of an axis
inline constexpr PlaneRef plane_of_face(u32 f) { return {f, of_face}; }

enum class PointKind : u8 {
  vertex,         // of the mesh: id[0]
  edge_crossing,  // half-edge id[0] through the plane id[1]; on the half-edge id[2] as well, or none
  plane_crossing  // of three planes
};
struct ArrangementPoint {
  Vec3 at;  // rounded to nearest
  u32 id[3];
  u8 axis[3];  // of PlaneRef, for each id that is a plane
  PointKind kind : 4;
  u8 exact : 4;  // bit i: at[i] is the coordinate itself
};
static_assert(sizeof(ArrangementPoint) == 40);
inline constexpr u8 all_exact = 7;

struct ArrangementPoints {
  const Mesh* mesh;
  Meter* meter;  // may be null
  Stack<ArrangementPoint> list;
  // Of as many slots as the points so far need; with memory for a full list.
  OpenHash by_position, by_origin;  // by_origin: where equal points have several origins, only the first is known
};

inline constexpr u32 point_hash_slots(u32 points) { return 2 * points + 1; }

// Forgets all points.
void clear(ArrangementPoints& a);

// The number of an equal point in the list, added if it is new; none if the list is full. Expected O(1).
u32 add_vertex_point(ArrangementPoints& a, u32 v);
// `met`: an edge in the plane that holds the point, or none. Two edges meet in one point, whatever the planes.
u32 add_edge_crossing(ArrangementPoints& a, u32 half_edge, PlaneRef plane, u32 met = none);
u32 add_plane_crossing(ArrangementPoints& a, PlaneRef p, PlaneRef q, PlaneRef r);

ExactPlane exact_plane(const Mesh& m, PlaneRef plane);
// Its normal, each component off by at most 4 * 2^-53 of its magnitude.
NormalOf<Vec3> rounded_normal(const Mesh& m, PlaneRef plane);
// The sign of a component of the cross product of two such normals, or 2 where rounding decides.
int filtered_cross(u32 axis, const NormalOf<Vec3>& a, const NormalOf<Vec3>& b);
// Likewise of the dot product.
int filtered_dot(const NormalOf<Vec3>& a, const NormalOf<Vec3>& b);

ExactPoint exact_point(const ArrangementPoints& a, u32 p);

// The sign of p[axis] - q[axis].
int compare_along(const ArrangementPoints& a, u32 axis, u32 p, u32 q);
// The turn of p, q, r as seen along an axis: +1 counterclockwise. Pre: the points lie in a plane without that axis.
int turn(const ArrangementPoints& a, u32 axis, u32 p, u32 q, u32 r);
// The same with a point of double coordinates for r.
int turn(const ArrangementPoints& a, u32 axis, u32 p, u32 q, const Vec3& r);

}  // namespace tpa
