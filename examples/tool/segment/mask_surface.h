// SPDX-License-Identifier: MIT
// mask_surface: the surface of a mask's voxels: closed, manifold and free of self-intersections, whatever the mask.
#pragma once

#include "tool/io/mesh_io.h"
#include "tool/io/volume.h"

namespace tool {

// `mask` has a nonzero value for each voxel of the grid that is inside. Cubes between eight voxel centres consist of
// six tetrahedra each, along their main diagonal; the surface crosses edges in the middle (marching tetrahedra). Voxels
// are connected across faces, and across the diagonals along which both indices or all three grow. In millimetres,
// wound outwards. O(voxels).
TriangleMesh mask_surface(const Volume& grid, const std::vector<uint8_t>& mask);

}  // namespace tool
