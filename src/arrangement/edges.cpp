// SPDX-License-Identifier: MIT
#include "arrangement/edges.h"

#include "base/sort.h"

namespace tpa {

namespace {

u32 hash_of_edge(u32 p, u32 q) { return scattered(min_of(p, q), max_of(p, q)); }

u32& edge_slot(const Arrangement& a, u32 p, u32 q) {
  const u32 low = min_of(p, q), high = max_of(p, q);
  return a.edges.find(hash_of_edge(p, q), [&](u32 h) {
    const u32 t = point_at_tail(a, h), u = point_at_head(a, h);
    return (t == low && u == high) || (t == high && u == low);
  });
}

// ---------------------------------------------------------------- order round an edge

// The normal of a piece, or its opposite, so that a turn of 90 degrees about the edge makes the direction from the edge
// into the piece.
struct Spoke {
  u32 half_edge;
  u32 face, facet;
  i32 sign;
};

// Signs of the cross product of two spokes, along the edge, and of their dot product.
struct Round {
  const Mesh& m;
  u32 axis;   // along which the edge has an extent
  i32 ahead;  // its sign, from the lower point to the higher

  int cross(const Spoke& s, const Spoke& t) const {
    if (s.facet == t.facet) return 0;
    const PlaneRef p = plane_of_face(s.face), q = plane_of_face(t.face);
    int sign = filtered_cross(axis, rounded_normal(m, p), rounded_normal(m, q));
    if (sign == 2) sign = cross_sign(axis, exact_plane(m, p), exact_plane(m, q));
    return sign * ahead * s.sign * t.sign;
  }
  int dot(const Spoke& s, const Spoke& t) const {
    const PlaneRef p = plane_of_face(s.face), q = plane_of_face(t.face);
    int sign = filtered_dot(rounded_normal(m, p), rounded_normal(m, q));
    if (sign == 2) sign = dot_sign(exact_plane(m, p), exact_plane(m, q));
    return sign * s.sign * t.sign;
  }
};

// Within the first half turn from a spoke, straight across, or beyond.
enum Half : int { same, first_half, across, second_half };
Half half_of(const Round& round, const Spoke& from, const Spoke& s) {
  const int side = round.cross(from, s);
  if (side != 0) return side > 0 ? first_half : second_half;
  return round.dot(from, s) > 0 ? same : across;
}

Round round_edge(const Arrangement& a, u32 h) {
  const u32 p = point_at_tail(a, h), q = point_at_head(a, h), low = min_of(p, q), high = max_of(p, q);
  const Vec3 way = a.points.list[high].at - a.points.list[low].at;
  u32 axis = abs_of(way.y) > abs_of(way.x) ? 1 : 0;
  axis = abs_of(way.z) > abs_of(axis == 0 ? way.x : way.y) ? 2 : axis;
  for (u32 i = 0; i < 3; ++i, axis = (axis + 1) % 3)
    if (const int ahead = compare_along(a.points, axis, high, low); ahead != 0) return {*a.mesh, axis, ahead};
  return {*a.mesh, 0, 0};
}

// Units of work.
constexpr u64 of_comparison = 4;

// Sorts the ring of h, of more than two half-edges. False if two pieces lie upon each other.
bool sort_ring(Arrangement& a, u32 first, u32& head) {
  const Round round = round_edge(a, first);
  Stack<u32>& ring = a.queue;
  ring.clear();
  u32 h = first;
  do {
    ring.push(h);
    h = a.around[h];
  } while (h != first);
  spend(meter_of(a), of_comparison * (ring.size + sorting_steps(ring.size)));
  const auto spoke = [&](u32 g) {
    const CutPiece& piece = a.pieces[face_of(g)];
    return Spoke{g, piece.face, piece.facet, runs_upward(a, g) ? 1 : -1};
  };
  sort_in_place(ring.data, ring.size);
  const Spoke start = spoke(ring[0]);
  bool distinct = true;
  sort_in_place(ring.data + 1, ring.size - 1, [&](u32 g, u32 k) {
    if (g == k) return false;
    const Spoke s = spoke(g), t = spoke(k);
    const Half of_s = half_of(round, start, s), of_t = half_of(round, start, t);
    if (of_s != of_t) return of_s < of_t;
    const int side = round.cross(s, t);
    distinct = distinct && side != 0;
    return side > 0 || (side == 0 && g < k);
  });
  for (u32 i = 0; i < ring.size; ++i) a.around[ring[i]] = ring[i + 1 < ring.size ? i + 1 : 0];
  for (u32 i = 1; i < ring.size; ++i) distinct = distinct && half_of(round, start, spoke(ring[i])) != same;
  head = ring[0];
  return distinct;
}

}  // namespace

u32 find_edge(const Arrangement& a, u32 p, u32 q) { return edge_slot(a, p, q); }

bool link_edges(Arrangement& a) {
  a.edges.size = 3 * a.pieces.size + 1;  // of the room for all pieces
  a.edges.clear();
  spend(meter_of(a), 3 * u64{a.pieces.size});
  constexpr u32 ahead = 12;
  for (u32 h = 0; h < 3 * a.pieces.size; ++h) {
    if (h + ahead < 3 * a.pieces.size)
      a.edges.fetch_slot(hash_of_edge(point_at_tail(a, h + ahead), point_at_head(a, h + ahead)));
    u32& first = edge_slot(a, point_at_tail(a, h), point_at_head(a, h));
    if (first == none) {
      first = a.around[h] = h;
    } else {
      a.around[h] = a.around[first];
      a.around[first] = h;
    }
  }
  for (u32 i = 0; i < a.edges.size; ++i) {
    u32& first = a.edges.slot[i];
    if (first == none || a.around[a.around[first]] == first) continue;
    if (!sort_ring(a, first, first) || has_stopped(a)) return false;
  }
  return true;
}

}  // namespace tpa
