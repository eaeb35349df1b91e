// SPDX-License-Identifier: MIT
// voxel_topology: surfaces and genus of voxels themselves, without a mesh, and how far noise decides on both.
#pragma once

#include "tool/segment/object.h"

namespace tool {

// The border of a set of voxels that are connected across faces; all others are connected across corners, too.
struct VoxelTopology {
  uint64_t voxels = 0;
  uint64_t surfaces = 0;  // connected parts of the border, those of hollows included
  int64_t genus = 0;      // sum over all surfaces

  bool operator==(const VoxelTopology&) const = default;
};

// `mask` is nonzero for each voxel of the set. O(voxels).
VoxelTopology topology_of(const Volume& grid, const std::vector<uint8_t>& mask);

// Topology that noise can make of an object. The voxels with grey values nearer to the threshold than `shift` may lie
// on either side.
struct NoiseRange {
  double shift = 0;         // grey values; 0 without noise
  VoxelTopology object;     // as the threshold has it
  VoxelTopology surest;     // the object's voxels beyond the threshold by more than `shift`
  VoxelTopology uncertain;  // the object, and voxels across its faces beyond the threshold but for less than `shift`

  // Noise decides neither on genus nor on the number of surfaces.
  bool is_sure() const;
};

// `noise`: standard deviation of grey values. O(voxels).
NoiseRange topology_within_noise(const Volume& volume, const Threshold& threshold, const Object& object, double noise);

}  // namespace tool
