// SPDX-License-Identifier: MIT
// crossings: where surfaces of several labels meet each other.
#pragma once

#include "tool/io/mesh_io.h"

namespace tool {

struct Crossings {
  uint64_t triangles = 0;  // pairs of triangles of different labels that meet; touching counts
  uint64_t labels = 0;     // pairs of labels with such triangles
};

// Exact. Meshes of different labels have no vertex in common. Precondition: a label for each triangle.
// O(n log n + candidates) for n triangles.
Crossings count_crossings(const TriangleMesh& mesh);

}  // namespace tool
