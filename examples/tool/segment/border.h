// SPDX-License-Identifier: MIT
// border: what the grey values do where the object ends, and the width of the balloon's force that follows.
#pragma once

#include "tool/segment/object.h"

namespace tool {

struct Border {
  uint64_t faces = 0;   // between a voxel of the object and one on the other side of the threshold
  double area = 0;      // of these faces, in mm2
  double contrast = 0;  // median step of the grey value across them
  double noise = 0;     // standard deviation, by the median over voxels within the object
};

// O(voxels).
Border measure_border(const Volume& volume, const Object& object);

// Grey values round the threshold over which the force falls from full strength to zero. A 64th of the
// contrast, or a quarter of the noise if that is more, but at most half of the contrast.
double force_width(const Border& border);

}  // namespace tool
