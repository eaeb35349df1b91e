// SPDX-License-Identifier: MIT
// refine: edges of a mesh cut in half, without a change of its surface.
#pragma once

#include <functional>

#include "tool/io/mesh_io.h"

namespace tool {

// Cuts edges (a, b) with is_long(a, b), each once; triangles round them are divided, new vertices come last. Returns
// the ends of the edges cut, in the order of the new vertices. O(V + n log n) for n edges.
std::vector<std::pair<uint32_t, uint32_t>> cut_edges(TriangleMesh& mesh,
                                                     const std::function<bool(uint32_t, uint32_t)>& is_long);

}  // namespace tool
