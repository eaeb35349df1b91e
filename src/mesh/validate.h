// SPDX-License-Identifier: MIT
// validate: checks of positions and triangles alone, and the topology of a closed oriented 2-manifold (section 2).
#pragma once

#include "mesh/components.h"

namespace tpa {

// Numbers as TPA_DEFECT_... of the header.
enum : i32 { defect_not_finite = 1, defect_magnitude = 2, defect_index_range = 3 };

// The first vertex with a position that is not finite, else the first one out of the exact range.
Defect check_positions(const Vec3* position, u32 count);
// The first corner that names no vertex.
Defect check_indices(const u32* corner, u32 face_count, u32 vertex_count);

struct Measures {
  i64 euler, genus;
  u32 components;
  f64 volume, area;
};

// Measures a mesh after connect(), and fills c. `queue` as for find_components(). O(V).
Measures measure(const Mesh& m, Components& c, u32* queue);

}  // namespace tpa
