// SPDX-License-Identifier: MIT
// contact_scenes: closed meshes that reach into each other at one place, drawn at random. Tubes, balls and
// sheets, all bumpy, with edges of about length one and random diagonals, in random poses.
#pragma once

#include <vector>

#include "support/support.h"

namespace figures {

// A closed mesh whose front is at the origin; its body lies below.
support::Mesh RandomTube(support::Random& random);
support::Mesh RandomBall(support::Random& random);
support::Mesh RandomSheet(support::Random& random);

// Tubes, balls and at most one sheet; no two point the same way.
struct Scene {
  std::vector<support::Mesh> parts;      // with their fronts at about the origin
  std::vector<support::Point> outwards;  // unit: the direction in which a part may be drawn back
  std::vector<double> depths;            // the way of a part after its first contact
};
Scene RandomScene(int parts, uint64_t seed);

}  // namespace figures
