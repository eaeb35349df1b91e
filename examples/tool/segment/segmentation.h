// SPDX-License-Identifier: MIT
// segmentation: a volume or phantom, the balloon in it, and the report, shared by `topoadapt segment` and the demo.
#pragma once

#include <optional>

#include "tool/json.h"
#include "tool/segment/balloon.h"
#include "tool/segment/phantom.h"
#include "tool/topology.h"

namespace tool {

struct Segmentation {
  Volume volume;
  std::optional<Phantom> phantom;  // its volume has been moved to `volume`
  BalloonOptions options;
  Surface surface;
  BalloonResult result;
  TriangleMesh mesh;
  std::vector<Part> parts;
  uint64_t self_intersections = 0;
  double mean_distance = 0, largest_distance = 0;  // of the vertices from the phantom's surface, in voxels
};

// Options that suit the phantom: seed, radius and threshold.
Status prepare_phantom(const std::string& name, uint64_t noise_seed, Segmentation& s);

// Inflates the balloon and measures the result.
Status run_segmentation(Segmentation& s, const BalloonProgress& progress);

// Writes the members of the report.
void describe(JsonWriter& json, const Segmentation& s);

}  // namespace tool
