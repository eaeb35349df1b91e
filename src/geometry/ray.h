// SPDX-License-Identifier: MIT
// ray: winding numbers by rays in +x (paper section 2). The ray from p starts at p + (0, eps, eps^2) with eps > 0 and
// infinitely small (simulation of simplicity, Edelsbrunner & Muecke 1990). The ray passes through no edge and no
// vertex, so the crossings of a closed oriented mesh add up to the winding number of p. All answers are exact for
// coordinates that are zero or of magnitude within [2^-100, 2^100].
#pragma once

#include "base/vec3.h"

namespace tpa {

int ray_crossing_exact(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

// 0 for a ray from p that misses the triangle abc, +1 for a ray that leaves through the side of the normal
// (normal.x > 0), -1 for a ray that enters. Triangles parallel to x are never crossed. \pre p is not on the closed
// triangle.
inline int ray_crossing(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  if (p.x > a.x && p.x > b.x && p.x > c.x) return 0;
  if ((p.y < a.y && p.y < b.y && p.y < c.y) || (p.y >= a.y && p.y >= b.y && p.y >= c.y)) return 0;
  if ((p.z < a.z && p.z < b.z && p.z < c.z) || (p.z >= a.z && p.z >= b.z && p.z >= c.z)) return 0;
  return ray_crossing_exact(p, a, b, c);
}

// The star of a vertex p of a closed mesh is the fan (p, link[i], link[i + 1 mod n]), oriented outward. For a star that
// does not intersect itself, the next three functions tell on which side of the star the ray from p runs beyond it:
// +1 outside, -1 inside, 0 for no answer. With the star's own triangles left out, the crossings of the rest of the mesh
// add up to the winding number of the points p + (t, eps, eps^2), t small but large against eps.

// The side that the ray leaves to through the topmost triangle over p + (0, eps, eps^2), by the sign of the triangle's
// outward normal in x. 0: no triangle of the star lies over that point.
int ray_leaves_star(const Vec3& p, const Vec3* link, u32 n);

// The side where triangles of the star hold the direction +x, as on the side of a cube: one triangle with +x inside, or
// two with an edge along +x. 0: no triangle holds +x.
int side_beside_triangle(const Vec3& p, const Vec3* link, u32 n);

// The side where both functions above return 0. Let a half plane turn about the line through p along x, from (1, eps)
// in the yz plane on. The half plane passes through points of the wanted side until it touches the star, in edges to
// corners of the link. There the whole link is on one side of the half plane, so the turn of the link at such a corner
// tells the side. Where no corner is touched within half a turn, a corner behind p on the line serves, since every half
// plane touches such a corner. 0 only for a star that meets itself.
int side_beside_corner(const Vec3& p, const Vec3* link, u32 n);

}  // namespace tpa
