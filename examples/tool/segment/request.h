// SPDX-License-Identifier: MIT
// request: what the words after `topoadapt segment` ask for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tool/commands.h"
#include "tool/io/volume_io.h"
#include "tool/segment/segmentation.h"
#include "tool/segment/selection.h"
#include "tool/view/view.h"

namespace tool {

enum class OutputSpace { of_file, ras, lps, voxel };

struct SegmentRequest {
  std::string volume, phantom;  // one of the two
  uint64_t noise_seed = default_noise_seed;
  VolumeRequest reading;  // --time, --nan-as-background
  bool all_labels = false;
  bool info = false;    // says what the volume holds, and segments nothing
  Selection selection;  // beside a phantom's own threshold
  double sigma = 0;
  std::vector<Point> voxel_seeds, world_seeds;
  // In place of what suits the volume or phantom.
  std::optional<double> radius, edge, edge_fine, width, tension, speed;
  uint64_t iterations = 5000;
  uint64_t threads = 1;
  OutputSpace space = OutputSpace::of_file;
  bool partial = false;   // a mesh that does not fill the object is an answer, too
  double drop_below = 0;  // mm3
  std::optional<int64_t> genus;
  uint64_t every = 0;                  // iterations between two frames; 0: none
  std::string frames;                  // their folder
  std::string resume, save;            // files of a saved state
  std::string start_mask, start_mesh;  // in place of balls
  std::string mask;                    // file of the voxels inside the mesh
  Outputs outputs;
  ViewOutputs view;
  SurfaceBounds bounds;
};

// Without balls, and without another surface, a label's own surface is the first.
inline bool starts_from_label(const SegmentRequest& r) {
  const bool other = !r.voxel_seeds.empty() || !r.world_seeds.empty() || !r.start_mask.empty() || !r.start_mesh.empty();
  return (r.selection.label || r.all_labels) && !other;
}

// Everything that can be wrong before a voxel is read.
Status read_request(int count, const char* const* words, SegmentRequest& request);

// The member "options": all as used.
void describe(JsonWriter& json, const SegmentRequest& request, const Segmentation& s);

// The world of the mesh that is written; unnamed for voxels, and where the file names none.
Space space_of_output(const SegmentRequest& request, const Volume& volume);

// From the volume's world to the space asked for.
Affine output_map(const SegmentRequest& request, const Volume& volume);

// From places in mm to the volume's world: in RAS or LPS if --space says so. Voxels are no mm; --seed has them.
Affine from_named_space(const SegmentRequest& request, const Volume& volume);

}  // namespace tool
