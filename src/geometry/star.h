// SPDX-License-Identifier: MIT
// star: a proof that the triangles at a vertex do not meet beyond shared corners and edges (paper section 3). The star
// of a vertex p is the fan of triangles (p, link[i], link[i + 1 mod n]).
#pragma once

#include "base/vec3.h"

namespace tpa {

// Cheap proof that no two triangles of p's fan meet except in shared corners and edges: seen along the sum of the fan's
// normals, all triangles turn the same way and go round p once. False means "not proven". Never proven for n < 3 or
// n > 32. Writes behind the n corners: `link` has room for star_room in all.
inline constexpr u32 star_is_unfolded_limit = 32, star_room = star_is_unfolded_limit + 1;
bool star_is_unfolded(const Vec3& p, Vec3* link, u32 n);

}  // namespace tpa
