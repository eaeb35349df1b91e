// SPDX-License-Identifier: MIT
// tidy_cut: the surface after the exact cut of a step. Seams bring many vertices, closer to each other than those of
// the mesh; the next moves would fold their edges. New vertices merge until they are about as far apart as old ones.
// Nothing is smoothed: between triangles of very different sizes, smoothing would carry the seam away from the bodies.
// Each operation is tested, so the mesh stays free of contacts.
#pragma once

#include "islands/specks.h"

namespace tpa {

// Specks first, then the rest. O(faces round new vertices).
void tidy_cut(Attempt& a, const CutSizes& sizes);

}  // namespace tpa
