// SPDX-License-Identifier: MIT
// facing: facets that wind the other way round than their neighbours.
#pragma once

#include <cstddef>

#include "tool/io/mesh_io.h"

namespace tool {

// Within each part that edges of two triangles connect, two choices are consistent: the choice of the majority stays,
// and the rest is turned; without a majority, the choice with the greater signed volume stays. Parts without a
// consistent choice stay as they are. Returns how many were turned. Corners of each triangle differ. O(n log n).
size_t turn_facets(TriangleMesh& mesh);

}  // namespace tool
