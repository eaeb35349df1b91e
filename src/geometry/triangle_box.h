// SPDX-License-Identifier: MIT
// triangle_box: a cheap proof that a triangle does not meet a box (separating axis theorem, Akenine-Möller 2001). The
// box of a long thin triangle meets most boxes near by; the triangle itself meets few.
#pragma once

#include "geometry/box.h"

namespace tpa {

// Corners within -2 .. 2, rounded to single precision.
struct FlatTriangle {
  f32 corner[3][3];
};

// Is it proven that the triangle has no point in common with a box within -4 .. 4, although all corners and bounds may
// be off by 2^-23?
bool provably_off(const FlatTriangle& t, const Box& b);

}  // namespace tpa
