// SPDX-License-Identifier: MIT
#include "step/approach.h"

#include "block/marks.h"

namespace tpa {

// Let all ways differ from the mean way by at most r. Then two vertices approach each other by at most 2 r. So do
// points of faces, since the way of a point lies between the ways of the corners. Any centre would serve; the mean
// gives a small r if most vertices move alike.
f64 bound_of_approach(const Workspace& w) {
  const Vec3* position = w.edit.mesh.position;
  const auto way = [&](u32 v) {
    return state_of(w, v, frozen_state) == free_vertex ? w.target[v] - position[v] : Vec3{};
  };
  Vec3 sum = {};
  for (u32 v : w.targets) sum = sum + way(v);
  const u32 count = w.edit.mesh.vertex_count;
  const Vec3 mean = (count > 0 ? 1.0 / count : 0) * sum;
  f64 farthest = w.context.target_count < count ? squared_length(mean) : 0;
  for (u32 v : w.targets) farthest = max_of(farthest, squared_length(way(v) - mean));
  // Rounded up. In units of 2^-53: a way is off by 1 of r + |mean|; its difference to the mean by 1 of r, the length by
  // 2.5, the sum below by 1. Altogether 5.5 of r and 1 of |mean|, of 8.
  const f64 r = square_root(farthest);
  return 2 * (r + 0x1p-50 * (r + size_of(mean)));
}

// Positions and goals are off by sqrt(3) 2^-53 of the coordinate each time. An error that a sub-step leaves is made
// good in the sub-steps that are left, so of n sub-steps the last carries up to 1 + 2 ln n errors, with 2 ways:
// 100 2^-53 for n = 2^20. The rest of 2^-46 is for vertices that smoothing moves outward.
f64 rounding_of_substeps(const Workspace& w) {
  const Mesh& m = w.edit.mesh;
  f64 largest = 0;
  const auto add = [&](const Vec3& p) {
    largest = max_of(largest, max_of(abs_of(p.x), max_of(abs_of(p.y), abs_of(p.z))));
  };
  for (u32 v = 0; v < m.vertex_count; ++v) add(m.position[v]);
  for (u32 v : w.targets) add(w.target[v]);
  return 0x1p-46 * largest;
}

u64 substeps_for(f64 approach, f64 thickness, f64 rounding) {
  constexpr u64 most = u64{1} << 52;
  if (!(rounding < thickness)) return most;
  // The margin keeps errors relative to the ways below the thickness.
  const f64 parts = approach / (thickness - rounding) * (1 + 0x1p-20);
  return parts < 0x1p52 ? static_cast<u64>(parts) + 1 : most;
}

}  // namespace tpa
