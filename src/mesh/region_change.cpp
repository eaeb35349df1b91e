// SPDX-License-Identifier: MIT
#include "mesh/region_change.h"

namespace tpa {

void RegionChange::add_sweep(const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b, u32 v, u32 f) {
  const f64 change = six_volumes_of(from, to, a, b);
  if (change == 0) return;
  add_volume(change);
  const Vec3 hull[] = {from, to, a, b};
  add_hull(hull, 4, met != nullptr ? met->near(v, f) : none);
}

}  // namespace tpa
