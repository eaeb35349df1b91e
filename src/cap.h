// cap: triangulations of one closed loop in space without new vertices (paper section 5, nested objects:
// "both parts are triangulated").
//
// Short loops get the best of all triangulations by dynamic programming over chords (Klincsek 1980; Barequet
// and Sharir 1995), O(n^3) time and O(n^2) room; longer ones are clipped ear by ear, O(n log n).
#pragma once

#include "handle_words.h"
#include "vec3.h"

namespace tpa {

inline constexpr u32 longest_best_cap = 64;

enum class CapWeight : u8 {
  length,  // of the chords
  area,    // of the faces
  angle,   // squared cosines of the faces' largest angles: prefers well shaped faces
};

constexpr u64 best_cap_scratch_bytes(u64 n) { return n * n * (sizeof(f64) + 1); }
constexpr u64 clip_scratch_bytes(u64 n) { return n * (3 * sizeof(u32) + 3 * 16) + 64; }

// The best cap of points[0 .. n-1]; n - 2 faces with corners numbered as the points, such that each edge of
// the loop is traversed forwards. Pre: 3 <= n <= 64, scratch of best_cap_scratch_bytes(n), aligned for f64.
void best_cap(const Vec3* points, u32 n, CapWeight weight, u8* scratch, HandleFace* out);

// A cap made by always clipping the ear of least weight. Pre: n >= 3, scratch of clip_scratch_bytes(n),
// aligned.
void clip_cap(const Vec3* points, u32 n, CapWeight weight, u8* scratch, HandleFace* out);

}  // namespace tpa
