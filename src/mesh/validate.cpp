// SPDX-License-Identifier: MIT
#include "mesh/validate.h"

namespace tpa {

Defect check_positions(const Vec3* position, u32 count) {
  Defect magnitude;
  for (u32 v = 0; v < count; ++v)
    for (int i = 0; i < 3; ++i) {
      const f64 x = position[v][i];
      if (!(abs_of(x) <= DBL_MAX)) return {defect_not_finite, v, 0};
      if (magnitude.kind == 0 && !in_exact_range(x)) magnitude = {defect_magnitude, v, 0};
    }
  return magnitude;
}

Defect check_indices(const u32* corner, u32 face_count, u32 vertex_count) {
  for (u32 f = 0; f < face_count; ++f)
    for (u32 i = 0; i < 3; ++i)
      if (corner[3 * f + i] >= vertex_count) return {defect_index_range, f, corner[3 * f + i]};
  return {};
}

Measures measure(const Mesh& m, Components& c, u32* queue) {
  find_components(m, c, queue);
  Measures out{0, 0, c.list.size, 0, 0};
  for (const Component& part : c.list) {
    out.euler += part.euler / 2;
    out.genus += genus_of(part.euler);
  }
  // Relative to a vertex of the mesh: far from the origin few digits would be left.
  const Vec3 o = m.vertex_count > 0 ? m.position[0] : Vec3{};
  f64 volume = 0, area = 0;
  for (u32 f = 0; f < m.face_count; ++f) {
    const Vec3 a = corner_position(m, 3 * f) - o, b = corner_position(m, 3 * f + 1) - o,
               d = corner_position(m, 3 * f + 2) - o;
    volume += dot(a, cross(b, d));
    area += length(cross(b - a, d - a));
  }
  out.volume = volume / 6;
  out.area = area / 2;
  return out;
}

}  // namespace tpa
