// SPDX-License-Identifier: MIT
// point_origins: the parents of the points of an exact cut. All points along a seam have theirs on one side of it, so
// that the seam follows one body when it moves next.
#pragma once

#include "arrangement/arrangement.h"

namespace tpa {

// Fills a.origins. While the faces and vertices that made the points still exist; uses a.vertex, a.place and a.reached.
// O(pieces).
void note_point_origins(const Mesh& m, Arrangement& a);

}  // namespace tpa
