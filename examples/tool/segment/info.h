// SPDX-License-Identifier: MIT
// info: what a volume holds, and what a segmentation of it could begin with.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tool/io/volume.h"
#include "tool/segment/object.h"

namespace tool {

// The voxels on one side of a threshold.
struct SideInfo {
  Threshold threshold;
  uint64_t voxels = 0, parts = 0;  // parts are connected across faces
  uint64_t largest = 0;            // voxels of the largest part
  Index seed;                      // its voxel farthest from the part's border, faces of voxels counted
  int depth = 0;                   // so far
};

struct LabelInfo {
  int32_t label = 0;
  uint64_t voxels = 0;
};

struct VolumeInfo {
  double least = 0, most = 0, mean = 0;  // of the voxels that are numbers
  uint64_t nan = 0;
  double low = 0, high = 0;         // range of the histogram: all but outliers
  std::vector<uint64_t> histogram;  // outliers in the first and last bin
  double threshold = 0;
  bool is_given = false;          // the threshold, by the user
  std::vector<SideInfo> sides;    // dark, then bright; without a side that has no voxel
  std::vector<LabelInfo> labels;  // of a label map
};

inline constexpr size_t info_bins = 256;
// A volume of patches of at most so many whole numbers is taken for a label map.
inline constexpr size_t most_info_labels = 64;

// The threshold between two classes of grey values with the least variance within both (Otsu 1979): the middle between
// the last value of the one and the first value of the other bin in use.
double otsu_threshold(const std::vector<uint64_t>& histogram, double low, double high);

// O(voxels). `threshold` in place of Otsu's.
VolumeInfo info_of(const Volume& volume, const std::optional<double>& threshold);

}  // namespace tool
