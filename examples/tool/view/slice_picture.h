// SPDX-License-Identifier: MIT
// slice_picture: slices of a volume on a canvas.
#pragma once

#include <string>
#include <vector>

#include "tool/view/canvas.h"
#include "tool/view/slice.h"

namespace tool {

// Grey values from `low`, black, to `high`, white, with the contour, the letters of the patient's directions and the
// place along the axis.
void draw_slice(Canvas& canvas, const Box2& box, const Slice& slice, double low, double high);

struct SliceMark {
  Point voxel{};
  std::string name;
};
// The same with numbers of voxels along two sides, and crosses at voxels.
void draw_chart(Canvas& canvas, const Box2& box, const Slice& slice, double low, double high,
                const std::vector<SliceMark>& marks);

// Segments between grey values above a level and others, in voxels to the right and down.
std::vector<std::array<double, 4>> level_contour(const Slice& slice, double level);

}  // namespace tool
