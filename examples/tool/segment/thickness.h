// SPDX-License-Identifier: MIT
// thickness: how thick the object is round each of its voxels, and how long edges may be there.
#pragma once

#include "tool/segment/object.h"

namespace tool {

// Parts of the longest edge that lengths are told apart by.
inline constexpr int edge_steps = 255;

// Lengths of edges as parts of the longest, for each place.
struct EdgeField {
  Affine to_index;
  int nx = 0, ny = 0, nz = 0;
  double least = 1;                // of all voxels of the object; 1 where no part is thin
  std::vector<uint8_t> parts;      // for each voxel, in 255ths, 0 outside the object; empty where no part is thin
  std::vector<uint8_t> shortened;  // 1 for each voxel with another part since the last shorten_edges; empty before

  // The least part asked for by the voxels round a place.
  double part_at(const Point& p) const;

  // Whether a voxel round a place is shortened.
  bool is_shortened_at(const Point& p) const;
};

// An object of local radius r takes edges of this part of r: some sixteen round a tube.
inline constexpr double edge_of_radius = 0.4;

// The local radius at a voxel is that of the largest ball of the object that holds the voxel (Hildebrand & Ruegsegger
// 1997). Edges are edge_of_radius times that, from `shortest` to `longest`. Axes count as perpendicular.
// O(voxels * reach) for a reach of 2 / edge_of_radius of `longest` in voxels, at most the longest side of the volume,
// and O(voxels of a ball) for each middle of a thin part.
EdgeField measure_edges(const Volume& volume, const Object& object, double shortest, double longest);

// Lengths differ by at most this part of the distance, along axes, once edges have been shortened: remeshing comes to
// rest where edges of neighbouring places ask for similar lengths.
inline constexpr double edge_gradation = 0.5;

// Halves the parts at the voxels chosen (nonzero) and their neighbours, down to `least`, and grades the lengths round
// them. `longest`: the length of part 1, in mm. Returns the number of voxels with another part. O(voxels).
uint64_t shorten_edges(const Volume& volume, const Object& object, const std::vector<uint8_t>& chosen, double least,
                       double longest, EdgeField& field);

}  // namespace tool
