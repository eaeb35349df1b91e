// SPDX-License-Identifier: MIT
// topology: components of a closed mesh, for reports. Counted from the triangles alone, not asked of the library.
#pragma once

#include <vector>

#include "tool/io/mesh_io.h"

namespace tool {

struct Part {
  size_t vertices = 0, triangles = 0;
  long genus = 0;
  double volume = 0;
};

// Largest component (by vertices) first. O(V).
std::vector<Part> parts_of(const TriangleMesh& mesh);

}  // namespace tool
