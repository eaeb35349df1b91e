// SPDX-License-Identifier: MIT
// winding_number: the winding number of the mesh beside a vertex ("analyzing the positions of the vertices", section
// 2): the sum of the signed crossings of a ray. Crossings are exact and never degenerate, since the
// ray is moved symbolically (Edelsbrunner & Muecke 1990), so one ray always suffices.
#pragma once

#include "detect/near_faces.h"

namespace tpa {

// Winding number on the outer side of the surface at v; the inner side has one more. Casts a ray along x, towards the
// nearer side of the mesh. Pre: no face of the star of v is in contact with anything, else the sides of the star may
// disagree. False if v has more than 64 neighbours; then ask a neighbour. Expected O(faces along the ray).
bool outer_winding(const Mesh& m, const NearFaces& g, u32 v, i32 winding_at_infinity, i32& winding);

}  // namespace tpa
