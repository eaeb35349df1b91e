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
  Point world{};  // its centre, in millimetres of the file's world
};

struct Filling {
  uint64_t object = 0;            // voxels of the object
  uint64_t inside = 0;            // of these, with their centres enclosed by the mesh
  uint64_t near = 0;              // of these, with their centres outside, but no further than edges reach
  uint64_t rim = 0;               // voxels not of the object, enclosed, but no deeper than edges reach
  uint64_t beyond = 0;            // voxels not of the object, enclosed deeper
  uint64_t foreign = 0;           // of both, on the object's side of the threshold: parts of neighbours
  std::vector<Piece> left_out;    // the largest pieces of the object that are not enclosed
  std::vector<Piece> leaks;       // the largest pieces beyond that are of no neighbour
  std::vector<Piece> neighbours;  // the largest pieces of neighbours that are enclosed

  // Of the voxels that the object has: enclosed or near, and enclosed alone.
  double share() const { return part(inside + near); }
  double enclosed_share() const { return part(inside); }

 private:
  double part(uint64_t of) const { return object > 0 ? static_cast<double>(of) / static_cast<double>(object) : 1; }
};

// A round border lies outside its chords, however well the vertices lie on the border: triangles with edges of 2/5 of
// the local radius (thickness.h) lie inside by up to this part of an edge.
inline constexpr double reach_of_edge = 1.0 / 15;

// How far from the mesh a voxel counts as near: edges reach so far, and a quarter of a voxel is as much as noise and
// the steps of voxels ask for.
double reach_of_edges(const Volume& volume, double edge_length);

inline constexpr size_t most_pieces = 5;

// 1 for each voxel whose centre the mesh encloses, else 0. O(voxels).
std::vector<uint8_t> enclosed_voxels(const Volume& volume, const TriangleMesh& mesh);

// For each voxel of the object that the mesh leaves out, the distance of the centre from the mesh in mm, infinite
// beyond `reach`; 0 for all other voxels. O(voxels).
std::vector<float> distances_left_out(const Volume& volume, const Object& object, const TriangleMesh& mesh,
                                      double reach);

// Voxel centres with a winding number of 1 or more count as enclosed; `near` and `rim` lie within `reach` of the mesh.
// `mesh` and `reach` in millimetres. O(voxels + n log n) for n rows of voxels that triangles cross.
Filling compare(const Volume& volume, const Threshold& threshold, const Object& object, const TriangleMesh& mesh,
                double reach);

}  // namespace tool
