// SPDX-License-Identifier: MIT
#include "step/approach.h"

#include "step/attempt.h"

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
  // Rounded up: a way is off by half a unit in the last place, sums and roots of ways by at most four units.
  const f64 r = square_root(farthest);
  return 2 * (r + 0x1p-51 * (r + size_of(mean)));
}

u64 substeps_for(f64 approach, f64 thickness) {
  if (approach < thickness) return 1;
  // The margin keeps rounded parts of the ways below the thickness.
  const f64 parts = approach / thickness * (1 + 0x1p-20);
  return parts < 0x1p52 ? static_cast<u64>(parts) + 1 : u64{1} << 52;
}

}  // namespace tpa
