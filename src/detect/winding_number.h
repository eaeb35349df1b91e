// winding_number: which side of the surface is in, and which is out? Signed crossings of a ray, exact, without
// degenerate cases (the ray is moved symbolically, Edelsbrunner & Muecke 1990), so that no ray is ever cast twice.
#pragma once

#include "detect/near_faces.h"

namespace tpa {

// Winding number of the space on the outer side of the surface at v (its inner side has one more), by a ray along x, to
// the side of the mesh that is nearer. The star of v must not be in contact with anything, else the sides may not
// agree. False where v has more than 64 neighbours; then ask a neighbour. Expected O(faces along the ray).
bool outer_winding(const Mesh& m, const NearFaces& g, u32 v, i32 winding_at_infinity, i32& winding);

// Winding number at a point that lies on no face. Expected O(faces along the ray).
i32 winding_at(const Mesh& m, const NearFaces& g, const Vec3& p, i32 winding_at_infinity);

}  // namespace tpa
