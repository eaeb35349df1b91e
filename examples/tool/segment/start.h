// SPDX-License-Identifier: MIT
// start: surfaces for a balloon to begin with in place of balls.
#pragma once

#include <string>

#include "tool/io/mesh_io.h"
#include "tool/io/volume.h"

namespace tool {

// The surface of the voxels with the value `label`.
TriangleMesh label_surface(const Volume& volume, double label);

// The surface of the nonzero voxels of another volume, whose grid may be another one, in the world of `volume`. Where
// one of both names no space, the worlds count as the same.
Status read_start_mask(const std::string& path, const Volume& volume, TriangleMesh& first);

// A mesh file, with `to_world` from its places to the world of the volume.
Status read_start_mesh(const std::string& path, const Affine& to_world, TriangleMesh& first);

}  // namespace tool
