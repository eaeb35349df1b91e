// SPDX-License-Identifier: MIT
#include "results/region_volume.h"

#include "base/parallel.h"

namespace tpa {

f64 volume_of_region(const Workspace& w, const Exec& exec) {
  const Mesh& m = w.edit.mesh;
  if (m.vertex_count == 0) return 0;
  const Vec3 from = m.position[0];
  const f64 six_volumes = sum_of_chunks(exec, m.face_count, [&](u32 first, u32 last) {
    f64 sum = 0;
    for (u32 f = first; f < last; ++f)
      sum +=
          six_volumes_of(from, corner_position(m, 3 * f), corner_position(m, 3 * f + 1), corner_position(m, 3 * f + 2));
    return sum;
  });
  return abs_of(six_volumes) / 6;
}

}  // namespace tpa
