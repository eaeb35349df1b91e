// SPDX-License-Identifier: MIT
// small_contact: is a contact the small thing that the paper means (section 5)? Its clusters go whole. So each must be
// a small part of its surface, which goes on beyond its loops.
#pragma once

#include "cut/clusters.h"

namespace tpa {

// A cluster is small if the surface beyond its loops has so many times its area.
inline constexpr f64 area_beyond = 4;

// After judge_patches(): is every cluster small? False as well for a cluster without loops, a whole component. `mark`,
// per vertex, is zero before and after; `queue` has room for all vertices. Expected O(members).
bool are_small(const Mesh& m, const Clusters& r, f64* area, u8* mark, Stack<u32>& queue);

}  // namespace tpa
