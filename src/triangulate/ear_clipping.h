// SPDX-License-Identifier: MIT
// ear_clipping: triangulations of one closed loop in space without new vertices, ear by ear, in O(n log n) (paper
// section 5, nested objects: "both parts are triangulated"), for loops too long for
// triangulate/minimum_triangulation.h.
#pragma once

#include "triangulate/minimum_triangulation.h"

namespace tpa {

constexpr u64 clip_scratch_bytes(u64 n) { return n * (3 * sizeof(u32) + 3 * 16) + 64; }

// Makes a cap by always clipping the ear of least weight. Pre: n >= 3, scratch of clip_scratch_bytes(n), aligned for
// f64.
void clip_cap(const Vec3* points, u32 n, DiscWeight weight, u8* scratch, FaceCorners* out);

}  // namespace tpa
