// SPDX-License-Identifier: MIT
// packing: meshes and volumes as few bytes, which a page compresses and its script (web/data.js) unpacks.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "tool/io/mesh_io.h"
#include "tool/io/volume.h"

namespace tool {

// Positions are steps of 1/65535 of the box. Vertices in Morton order: for each axis, differences of successive steps
// (zigzag), low bytes then high bytes. Then triangles, by their least corner: its difference from the one before, and
// the two others less the least, as varints. Then a byte for each triangle with a mark, if there are marks.
struct PackedMesh {
  double box[6] = {};  // least x y z, greatest x y z
  size_t vertices = 0, triangles = 0;
  std::string bytes;
};

PackedMesh pack_mesh(const TriangleMesh& mesh, const std::vector<uint8_t>& marks);

// A byte for each voxel, as the difference from the voxel before along x. Grey values from `low` to `high` become 0 to
// 255. Means of steps[0] x steps[1] x steps[2] voxels, so that there are at most `most_page_voxels`.
struct PackedVolume {
  int steps[3] = {1, 1, 1}, size[3] = {};
  double low = 0, high = 0;
  Affine to_world;  // from places in the packed volume
  std::string bytes;
};

inline constexpr size_t most_page_voxels = size_t{1} << 22;

// The grey values that a picture shows as black and white: all but outliers.
std::pair<double, double> grey_range(const Volume& volume);

PackedVolume pack_volume(const Volume& volume);

}  // namespace tool
