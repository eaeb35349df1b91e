// SPDX-License-Identifier: MIT
// filling: how much of the object a mesh encloses, voxel by voxel, what the mesh leaves out, and where the mesh reaches
// beyond the object.
#pragma once

#include "tool/io/mesh_io.h"
#include "tool/segment/object.h"

namespace tool {

// Connected voxels, largest pieces first.
struct Piece {
  uint64_t voxels = 0;
  Index voxel;    // the one nearest to the middle of the piece
  Point world{};  // its centre, in millimetres
};

struct Filling {
  uint64_t object = 0;            // voxels of the object
  uint64_t inside = 0;            // of these, with their centres enclosed by the mesh
  uint64_t beyond = 0;            // voxels enclosed that are not of the object
  uint64_t foreign = 0;           // of these, on the object's side of the threshold: parts of neighbours
  std::vector<Piece> left_out;    // the largest pieces of the object that are not enclosed
  std::vector<Piece> neighbours;  // the largest pieces of neighbours that are enclosed

  double share() const { return object > 0 ? static_cast<double>(inside) / static_cast<double>(object) : 1; }
};

inline constexpr size_t most_pieces = 5;

// 1 for each voxel whose centre the mesh encloses, else 0. O(voxels).
std::vector<uint8_t> enclosed_voxels(const Volume& volume, const TriangleMesh& mesh);

// 1 for each voxel of the object that the mesh leaves out, else 0. O(voxels).
std::vector<uint8_t> left_out_voxels(const Volume& volume, const Object& object, const TriangleMesh& mesh);

// Voxel centres with a winding number of 1 or more count as enclosed. `mesh` in millimetres. O(voxels + n log n) for n
// rows of voxels that triangles cross.
Filling compare(const Volume& volume, const Threshold& threshold, const Object& object, const TriangleMesh& mesh);

}  // namespace tool
