// SPDX-License-Identifier: MIT
// random_box: a box whose lower corner lies within -1 .. 1, up to so large along each axis.
#pragma once

#include "geometry/box.h"
#include "support/support.h"

namespace support {

inline tpa::Box RandomBox(Random& random, double size) {
  tpa::Box b{};
  for (int k = 0; k < 3; ++k) {
    b.low[k] = static_cast<float>(Uniform(random, -1, 1));
    b.high[k] = b.low[k] + static_cast<float>(Uniform(random, 0, size));
  }
  return b;
}

}  // namespace support
