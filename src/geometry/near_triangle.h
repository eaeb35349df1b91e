// SPDX-License-Identifier: MIT
// near_triangle: how far a point lies from a triangle, in doubles.
#pragma once

#include "base/vec3.h"

namespace tpa {

// The squared distance to the nearest point of the triangle, also of one without area.
f64 squared_distance(const Vec3& p, const Triangle& t);

}  // namespace tpa
