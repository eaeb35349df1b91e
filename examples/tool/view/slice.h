// SPDX-License-Identifier: MIT
// slice: a plane of a volume across one of its axes, as a picture with the contour of a mesh. Axes are laid out as
// radiologists look: from the feet, from the front, from the patient's left.
#pragma once

#include <array>
#include <vector>

#include "tool/io/mesh_io.h"
#include "tool/io/volume.h"

namespace tool {

struct SliceLayout {
  size_t axis = 0, right = 0, down = 0;  // of the volume
  bool flip_right = false, flip_down = false;
  size_t world = 0;                   // the axis of the world that `axis` is nearest to
  char sides[2] = {}, poles[2] = {};  // letters of the patient's directions: left and right end, upper and lower; or 0
};

// `to_world` takes voxels to a world of that space.
std::array<SliceLayout, 3> slice_layouts(const Affine& to_world, Space space);

struct Slice {
  SliceLayout layout;
  int at = 0;                            // place along the axis
  int width = 0, height = 0;             // voxels to the right and down
  double step_right = 1, step_down = 1;  // millimetres for each
  std::vector<float> grey;               // row by row, from the upper left
  // Segments in voxels to the right and down; the centre of the first voxel is (0, 0).
  std::vector<std::array<double, 4>> contour;
};

// The mesh lies in the world of `to_world`, which takes the place of the volume's own map.
Slice slice_of(const Volume& volume, const Affine& to_world, const SliceLayout& layout, int at,
               const TriangleMesh& mesh);

}  // namespace tool
