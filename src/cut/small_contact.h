// SPDX-License-Identifier: MIT
// small_contact: is a contact the small thing that the paper means (section 5)? Its clusters go whole. So each must be
// a small part of its surface, which goes on beyond its loops.
#pragma once

#include "cut/clusters.h"

namespace tpa {

// A cluster is small if the surface beyond its loops has so many times its area.
inline constexpr f64 area_beyond = 4;

// What goes is no thicker than so many of the shortest edges there: as thick as wide for even triangles, and thin for
// slender ones, whose long edges reach far.
inline constexpr f64 edges_thick = 12;

// After judge_patches(): is every cluster small? False as well for a cluster without loops, a whole component. Adds the
// areas of the clusters times their widths, the roots of the areas, or thicknesses to `room`. `mark`, per vertex, is
// zero before and after; `queue` has room for all vertices. Expected O(members).
bool are_small(const Mesh& m, const Clusters& r, f64* area, u8* mark, Stack<u32>& queue, f64& room);

}  // namespace tpa
