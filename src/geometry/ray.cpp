// SPDX-License-Identifier: MIT
// ray: crossings and stars, with the start of the ray moved symbolically.
//
// Loops are bounded by the sizes of the exact numbers and by n.
#include "geometry/ray.h"

#include "geometry/constructed_point.h"
#include "geometry/predicates.h"

namespace tpa {

namespace {

// The sign of (1, eps) x (u - p) in the yz plane, eps > 0 and infinitely small: 0 where u is on the line through p
// along x.
int turn_to(const Vec3& p, const Vec3& u) { return u.z != p.z ? compare(u.z, p.z) : compare(p.y, u.y); }

// Side of p + (eps, eps^2) about the directed line ab in the yz plane: the coefficients of 1, eps and eps^2 in turn.
int perturbed_side(const Vec3& p, const Vec3& a, const Vec3& b) {
  const int side = flat_orient(0, a, b, p);
  return side != 0 ? side : turn_to(b, a);
}

}  // namespace

// Inside the projected triangle, the ray crosses if p is below the plane in x. A p in the plane would lie on the
// triangle, against the precondition.
int ray_crossing_exact(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const int turn = perturbed_side(p, a, b);
  if (turn == 0 || perturbed_side(p, b, c) != turn || perturbed_side(p, c, a) != turn) return 0;
  return orient3d(a, b, c, p) == -turn ? turn : 0;
}

namespace {

// A fan triangle (p, u, w) over the direction (1, eps) of the yz plane; turn is the sign of its normal's x.
struct FanTriangle {
  Vec3 u, w;
  int turn;
};

// 0 if the sector of (p, u, w), seen along x, does not contain (1, eps), else the sign of its normal's x.
int sector_turn(const Vec3& p, const Vec3& u, const Vec3& w) {
  const int to_w = turn_to(p, w);
  return to_w != 0 && turn_to(p, u) == -to_w && flat_orient(0, p, u, w) == to_w ? to_w : 0;
}

// Over (1, eps) a triangle with normal m rises by -(m.y + eps m.z) / m.x. Compares the rises, m.y first. Dyadic numbers
// of this degree take a tenth of the stack of expansions.
bool rises_higher(const Vec3& p, const FanTriangle& s, const FanTriangle& t) {
  const ExactPlane of_s = exact_plane(p, s.u, s.w), of_t = exact_plane(p, t.u, t.w);
  int sign = cross_sign(2, of_s, of_t);
  if (sign == 0) sign = cross_sign(1, of_t, of_s);
  return sign * s.turn * t.turn > 0;
}

}  // namespace

int ray_leaves_star(const Vec3& p, const Vec3* link, u32 n) {
  FanTriangle top = {p, p, 0};
  for (u32 i = 0; i < n; ++i) {
    const Vec3 &u = link[i], &w = link[i + 1 < n ? i + 1 : 0];
    const FanTriangle triangle = {u, w, sector_turn(p, u, w)};
    if (triangle.turn != 0 && (top.turn == 0 || rises_higher(p, triangle, top))) top = triangle;
  }
  return top.turn;
}

namespace {

// The half plane, bounded by the line through p along x, of a star's triangle that holds the direction +x. `aside` is a
// corner off the line; `side` is 1 if p + (0, eps, eps^2) is on the side of the triangle's outward normal, else -1.
struct HalfPlane {
  Vec3 aside;
  int side;
};

bool half_plane_of(const Vec3& p, const Vec3& u, const Vec3& w, HalfPlane& half) {
  if (flat_orient(0, p, u, w) != 0) return false;
  const int y = flat_orient(1, p, u, w), from_u = turn_to(p, u);
  half.side = y != 0 ? y : flat_orient(2, p, u, w);
  half.aside = from_u != 0 ? u : w;
  // Seen along its normal, the triangle goes counter-clockwise from u to w. Does it pass +x, and not -x?
  return half.side * (from_u - turn_to(p, w)) > 0;
}

}  // namespace

int side_beside_triangle(const Vec3& p, const Vec3* link, u32 n) {
  HalfPlane above{}, below{};  // with the point on the side of the normal, and on the other side
  for (u32 i = 0; i < n; ++i) {
    HalfPlane half;
    if (half_plane_of(p, link[i], link[i + 1 < n ? i + 1 : 0], half)) (half.side > 0 ? above : below) = half;
  }
  if (above.side == 0 || below.side == 0) return above.side + below.side;
  // The point is outside of a ridge, inside of a valley. In a ridge the second half plane goes down from the first,
  // against the normal of the first: (-d.z, d.y) or the opposite, for d from p to `aside`.
  const Vec3 &a = above.aside, &b = below.aside;
  return turn_to(p, a) * flat_orient(0, p, a, b);
}

int side_beside_corner(const Vec3& p, const Vec3* link, u32 n) {
  u32 first = 0;
  int side = 0;
  for (u32 i = 0; i < n; ++i) {
    const Vec3& u = link[i];
    int earlier = turn_to(p, u) - turn_to(p, link[first]);
    if (earlier == 0) earlier = flat_orient(0, p, u, link[first]);
    if (earlier < 0 || (earlier == 0 && side != 0)) continue;
    first = i;
    side = orient3d(p, link[(i + 1) % n], u, link[(i + n - 1) % n]);
  }
  return side;
}

}  // namespace tpa
