// SPDX-License-Identifier: MIT
#include "mesh/projection.h"

namespace tpa {

View view_along(const Vec3& normal) {
  const f64 x = abs_of(normal.x), y = abs_of(normal.y), z = abs_of(normal.z);
  const int axis = z >= x && z >= y ? 2 : y >= x ? 1 : 0;
  return {(axis + 1) % 3, (axis + 2) % 3, axis, normal[axis] < 0 ? -1 : 1};
}

}  // namespace tpa
