// SPDX-License-Identifier: MIT
// sphere: the initial mesh of most scenes.
#pragma once

#include "tool/io/mesh_io.h"

namespace tool {

// A sphere made of an octahedron with each edge cut into `parts` (at least 1): symmetric about the axes, so that no
// direction is preferred. 4 parts^2 + 2 vertices, edges of about pi / 2 * radius / parts.
TriangleMesh make_sphere(const double (&center)[3], double radius, int parts);

}  // namespace tool
