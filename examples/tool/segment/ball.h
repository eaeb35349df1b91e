// SPDX-License-Identifier: MIT
// ball: what the first balls hold, and whether the work that they begin is one for this machine.
#pragma once

#include "tool/segment/balloon.h"
#include "tool/segment/border.h"

namespace tool {

// Voxels whose centres lie in the first balls.
struct BallFit {
  uint64_t voxels = 0;
  uint64_t object = 0;   // of these, of the object
  uint64_t foreign = 0;  // of these, on the object's side of the threshold, but of a neighbour
  Index neighbour;       // one of the foreign voxels

  uint64_t outside() const { return voxels - object; }
};

BallFit fit_balls(const Volume& volume, const Threshold& threshold, const Object& object,
                  const std::vector<Point>& seeds, double radius);

// The same of a first surface's voxels (nonzero). Neighbours are of the object, then.
BallFit fit_start(const std::vector<uint8_t>& start, const Object& object);

// The largest radius up to `most` with which balls hold the object's voxels only; at least one mean side of a voxel.
double fitting_radius(const Volume& volume, const Object& object, const std::vector<Point>& seeds, double most);

// Fails where the grids of a segmentation take more memory than there is.
Status check_memory(const Volume& volume);

// Fails, naming the option, where a ball or an edge is larger than the volume, or where balls or the object would take
// more vertices than `bounds` allows or more memory than there is.
Status check_budget(const Volume& volume, const Border& border, const BalloonOptions& options,
                    const SurfaceBounds& bounds);

}  // namespace tool
