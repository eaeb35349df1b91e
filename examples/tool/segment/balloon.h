// SPDX-License-Identifier: MIT
// balloon: the deformable model of Chen & Medioni (1995) that section 6 of the paper segments with, on the public
// interface alone. A small sphere inside the object inflates along its normals until it meets the object's border;
// springs between neighbours keep the mesh even. Topology is the library's business.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "tool/events.h"
#include "tool/io/volume.h"
#include "tool/surface.h"

namespace tool {

struct BalloonOptions {
  double center[3] = {0, 0, 0};  // of the initial ball, in voxels
  double radius = 4;
  double threshold = 127.5;  // T
  bool bright = false;       // the object is brighter than T, not darker
  double edge_length = 1.7;  // as in the paper's meshes (table 1: area of the phantom / vertices)
  double coarseness = 1;     // edges are so many times longer while the balloon inflates; at rest they are refined to
                             // edge_length, and the balloon settles once more
  double speed = 0.38;       // k: edge lengths for each iteration where the image does not slow the balloon down
  double width = 0;          // w: grey values round T over which the speed falls to zero. 0: half of the contrast
                             // between the seed and T
  double tension = 0.25;     // g: part of the way to the mean of the neighbours
  uint32_t patience = 0;     // iterations for which touching parts go on through each other before they are
                             // joined: parts that overlap well join in one event, not corner by corner
  uint32_t most_iterations = 5000;
};

// detect: steps without a contact (they move and detect); adapt: steps with contacts; evolve: the balloon's own forces.
struct BalloonSeconds {
  double total = 0, detect = 0, adapt = 0, remesh = 0, evolve = 0;
};

struct BalloonResult {
  uint32_t iterations = 0;
  bool at_rest = false;  // ended because nothing moved any more
  EventCounts events;
  BalloonSeconds seconds;
};

// Called after each iteration with the result so far.
using BalloonProgress = std::function<void(uint32_t iteration, uint32_t vertices, double at_rest_fraction)>;

// Fails if the seed lies outside the volume or the object, or if the library fails.
Status inflate(const Volume& volume, const BalloonOptions& options, const BalloonProgress& progress, Surface& surface,
               BalloonResult& result);

}  // namespace tool
