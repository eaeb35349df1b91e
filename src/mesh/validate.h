// validate: is it a closed oriented 2-manifold, and what is its topology? Judged from positions and triangles alone.
#pragma once

#include "mesh/components.h"

namespace tpa {

// Numbers as TPA_DEFECT_... of the header.
enum : i32 { defect_not_finite = 1, defect_magnitude = 2, defect_index_range = 3 };

// First vertex whose position is not finite or out of the exact range.
Defect check_positions(const Vec3* position, u32 count);
// First corner that names no vertex.
Defect check_indices(const u32* corner, u32 face_count, u32 vertex_count);

struct Measures {
  i64 euler, genus;
  u32 components;
  f64 volume, area;
};

// Of a connected mesh (see connect()); fills c. O(V).
Measures measure(const Mesh& m, Components& c, u32* queue);

}  // namespace tpa
