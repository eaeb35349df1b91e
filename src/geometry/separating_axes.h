// SPDX-License-Identifier: MIT
// separating_axes: cheap proofs that triangles do not meet, if corners of one lie nearly in the plane of the other
// (paper section 3). There the orientation tests see only zeros and would all go to exact arithmetic. A direction
// within the plane, or across edges of both, separates most of these pairs with a margin far above any rounding error
// (separating axis theorem, Gottschalk, Lin & Manocha 1996). False means "not proven".
#pragma once

#include "base/vec3.h"

namespace tpa {

bool provably_apart(const Triangle& a, const Triangle& b);

// The triangles (v, a1, a2) and (v, b1, b2) share nothing besides v.
bool provably_apart_beyond_vertex(const Vec3& v, const Vec3& a1, const Vec3& a2, const Vec3& b1, const Vec3& b2);

// The triangles (u, v, oa) and (v, u, ob) share nothing off the segment uv: they are not folded onto each other.
bool provably_apart_beyond_edge(const Vec3& u, const Vec3& v, const Vec3& oa, const Vec3& ob);

}  // namespace tpa
