// SPDX-License-Identifier: MIT
// point_origins: the origins of an exact cut. All points along a seam have their parents on one side of it, so that the
// seam follows one body when it moves next.
#pragma once

#include "arrangement/arrangement.h"
#include "mesh/journal.h"

namespace tpa {

// Fills a.origins. While the faces and vertices that made the points still exist; uses a.vertex, a.place and a.reached.
// O(pieces).
void note_point_origins(const Mesh& m, Arrangement& a);

// Merged vertices may leave faces between old vertices that are part of no single old face: these have no origin. Looks
// at the claimed faces. O(claims).
void forget_false_origins(Edit& e);

}  // namespace tpa
