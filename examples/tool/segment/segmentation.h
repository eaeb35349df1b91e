// SPDX-License-Identifier: MIT
// segmentation: a volume or phantom, the balloon in it, and the report, shared by `topoadapt segment` and the demo.
#pragma once

#include <optional>

#include "tool/json.h"
#include "tool/segment/ball.h"
#include "tool/segment/balloon.h"
#include "tool/segment/border.h"
#include "tool/segment/filling.h"
#include "tool/segment/phantom.h"
#include "tool/segment/voxel_topology.h"
#include "tool/topology.h"

namespace tool {

// A pass after the first, with shorter edges round the voxels that the pass before has left out.
struct Pass {
  double shortest = 0;      // edge aimed at, in mm
  uint64_t missing = 0;     // voxels that it begins with
  uint64_t filled = 0;      // of these, by its end
  uint64_t iterations = 0;  // of all passes, at its end
  uint64_t vertices = 0;    // at its end
  double seconds = 0;
};

struct Segmentation {
  Volume volume;
  std::optional<Phantom> phantom;  // its volume has been moved to `volume`
  BalloonOptions options;
  SurfaceBounds bounds;
  Object object;
  Border border;
  NoiseRange noise_range;
  EdgeField edges;
  BallFit balls;
  Surface surface;
  BalloonState resumed, left;  // to go on from
  BalloonResult result;
  std::vector<Pass> passes;
  TriangleMesh mesh;        // in millimetres of the volume's world
  std::vector<Part> parts;  // of the mesh
  size_t dropped = 0;       // parts of less volume than asked for, no longer in the mesh
  Filling filling;
  uint64_t self_intersections = 0;
  double mean_distance = 0, largest_distance = 0;  // of the vertices from the phantom's surface, in voxels
};

// A mesh that fills a smaller share of the object's voxels does not fill the object.
inline constexpr double least_share = 0.95;

// A volume's own edge and radius, in mean sides of a voxel.
inline constexpr double default_edge = 1.7, default_radius = 4;

// Sum over all parts.
int64_t genus_of(const std::vector<Part>& parts);

// Options that suit the phantom: seed, radius and threshold.
Status prepare_phantom(const std::string& name, uint64_t noise_seed, Segmentation& s);

// Finds the object, and from it the width of the force, unless options give one. Checks balls, edges and memory.
Status prepare_object(Segmentation& s);

// Called before each pass after the first.
using PassWatch = std::function<void(const Segmentation& s, const Pass& pass)>;

// prepare_object, then inflates the balloon and measures the result. Parts of less than `drop_below` mm3 are left out.
// Where the mesh at rest leaves out voxels for want of shorter edges, passes with such edges follow, as long as each
// fills a quarter of what it begins with (passes.h).
Status run_segmentation(Segmentation& s, const BalloonWatch& watch, double drop_below = 0,
                        const PassWatch& before_pass = {});

// Writes the members of the report.
void describe(JsonWriter& json, const Segmentation& s);

}  // namespace tool
