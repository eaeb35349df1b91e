// SPDX-License-Identifier: MIT
// level_set: what a user would segment with instead: ITK's filter for level sets between two thresholds.
#pragma once

#include <cstdint>
#include <vector>

#include "tool/segment/balloon.h"

namespace bench {

struct LevelSetResult {
  double seconds = 0;  // of processor time until the surface was at rest, or the limit
  bool at_rest = false;
  uint32_t iterations = 0;
  std::vector<double> points;  // of the surface then: x, y, z
  std::vector<float> level;    // negative inside, for each voxel
};

// Grey values between which the level set grows, fastest in the middle.
struct GreyWindow {
  float lower, upper;
};

// From the same seed, in voxels, on one thread. The filter's own criterion (RMS change) need not be met
// where there is noise, and is met too early where grey values differ much, so the surface is looked at every 25
// iterations: it is at rest where the 100 iterations after did not change the volume within it by .1 %. The time of
// looking and of those iterations does not count. The work ends after `most_seconds` of processor time in any case;
// then the result is that of the last look.
LevelSetResult SegmentWithItk(const tool::Volume& volume, const tool::BalloonOptions& options, const GreyWindow& window,
                              double most_seconds);

}  // namespace bench
