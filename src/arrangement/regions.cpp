// SPDX-License-Identifier: MIT
#include "arrangement/regions.h"

#include "arrangement/edges.h"
#include "arrangement/traces.h"
#include "geometry/predicates.h"
#include "geometry/ray.h"

namespace tpa {

namespace {

// The winding number on the side of the piece that looks counter-clockwise round the half-edge's edge, or clockwise.
i32 winding_beside(const Arrangement& a, u32 h, bool counter_clockwise) {
  const CutPiece& piece = a.pieces[face_of(h)];
  return piece.winding + (runs_upward(a, h) == counter_clockwise ? 0 : piece.layers);
}
void set_winding_beside(Arrangement& a, u32 h, bool counter_clockwise, i32 winding) {
  CutPiece& piece = a.pieces[face_of(h)];
  piece.winding = winding - (runs_upward(a, h) == counter_clockwise ? 0 : piece.layers);
}

// Gives all pieces that depend on piece `first` winding numbers, relative to the first; a.queue lists them.
bool spread(Arrangement& a, u32 first) {
  a.queue.clear();
  a.queue.push(first);
  a.reached[first] = 1;
  a.pieces[first].winding = 0;
  for (u32 i = 0; i < a.queue.size; ++i)
    for (u32 h = 3 * a.queue[i]; h < 3 * a.queue[i] + 3; ++h) {
      const u32 g = a.around[h];
      if (g == h) continue;
      const i32 between = winding_beside(a, h, true);
      if (a.reached[face_of(g)] == 0) {
        a.reached[face_of(g)] = 1;
        set_winding_beside(a, g, false, between);
        a.queue.push(face_of(g));
      } else if (winding_beside(a, g, false) != between) {
        return false;
      }
    }
  return true;
}

// ---------------------------------------------------------------- the ray

Vec3 turned(const Vec3& p, u32 axis) {
  const int i = static_cast<int>(axis), j = i == 2 ? 0 : i + 1, k = j == 2 ? 0 : j + 1;
  return {p[i], p[j], p[k]};
}

Vec3 middle_of(const Arrangement& a, const CutPiece& piece) {
  Vec3 sum;
  for (u32 p : piece.p) sum = sum + a.points.list[p].at;
  return into_exact_range((1.0 / 3) * sum);
}

f64 area_of(const Arrangement& a, const CutPiece& piece) {
  const auto at = [&](u32 i) { return a.points.list[piece.p[i]].at; };
  return squared_length(area_normal(at(0), at(1), at(2)));
}

// Does the line along the axis through the rounded middle pass through the inside of the piece?
bool shows_middle(const Arrangement& a, const CutPiece& piece, u32 axis, const Vec3& middle) {
  int sum = 0;
  for (u32 i = 0; i < 3; ++i) sum += turn(a.points, axis, piece.p[i], piece.p[(i + 1) % 3], middle);
  return sum == 3 || sum == -3;
}

// A piece of the group for a ray, or none: the largest, else any.
u32 choose_start(const Arrangement& a) {
  u32 best = a.queue[0];
  for (u32 s : a.queue)
    if (area_of(a, a.pieces[s]) > area_of(a, a.pieces[best])) best = s;
  const auto serves = [&](u32 s) {
    const CutPiece& piece = a.pieces[s];
    return shows_middle(a, piece, axis_of(*a.mesh, piece.face), middle_of(a, piece));
  };
  if (serves(best)) return best;
  for (u32 s : a.queue)
    if (serves(s)) return s;
  return none;
}

// Units of work.
constexpr u64 of_crossing = 1, of_exact_heights = 40;

// The winding number in front of a piece: signed crossings of the line through its middle with faces beyond it. Faces
// of the same facet aside, no face meets the inside of a piece.
i32 winding_in_front(const Arrangement& a, const NearFaces& g, const CutPiece& piece, i32 winding_at_infinity) {
  const Mesh& m = *a.mesh;
  const u32 axis = axis_of(m, piece.face);
  const Vec3 middle = middle_of(a, piece);
  const ExactPlane plane = exact_plane(m, plane_of_face(piece.face));
  Box line = box_of(middle, middle, middle);
  line.low[axis] = -FLT_MAX;
  line.high[axis] = FLT_MAX;
  Vec3 from = turned(middle, axis);
  from.x = -largest_magnitude;
  i32 winding = winding_at_infinity;
  for_each_near(g, line, [&](u32 f) {
    const u32* c = m.corner + 3 * static_cast<size_t>(f);
    const auto corner = [&](u32 i) { return turned(m.position[c[i]], axis); };
    const int crossing = ray_crossing(from, corner(0), corner(1), corner(2));
    spend(g.meter, of_crossing);
    if (crossing == 0) return;
    spend(g.meter, of_exact_heights);
    if (const u32 place = place_of_face(a, f); place != none && a.facet[place] == piece.facet) return;
    if (compare_heights(axis, middle, exact_plane(m, plane_of_face(f)), plane) > 0) winding += crossing;
  });
  return plane.normal[axis].sign > 0 ? winding : winding - piece.layers;
}

}  // namespace

bool find_windings(Arrangement& a, const NearFaces& g, i32 winding_at_infinity) {
  for (u32 s = 0; s < a.pieces.size; ++s) a.reached[s] = 0;
  a.groups = 0;
  for (u32 first = 0; first < a.pieces.size; ++first) {
    if (a.reached[first] != 0) continue;
    ++a.groups;
    if (!spread(a, first)) return false;
    spend(meter_of(a), 8 + 3 * u64{a.queue.size});
    if (has_stopped(a)) return false;
    const u32 start = choose_start(a);
    if (start == none) return false;
    const CutPiece& piece = a.pieces[start];
    const i32 change = winding_in_front(a, g, piece, winding_at_infinity) - piece.winding;
    for (u32 s : a.queue) a.pieces[s].winding += change;
  }
  return true;
}

}  // namespace tpa
