// SPDX-License-Identifier: MIT
// selection: what of the grey values is the object: beyond a threshold, in a band, or one value of a label map.
#pragma once

#include <optional>
#include <vector>

#include "tool/segment/object.h"

namespace tool {

struct Selection {
  std::optional<double> threshold, lower, upper, label;
  bool bright = false;

  bool is_given() const { return threshold || lower || upper || label; }
};

// Makes the volume one with a single threshold, which is set: smooths grey values with `sigma` mm; a band becomes the
// distance of the grey value from the band's nearer end, a label 1 in 0, which is smoothed then. NaN becomes
// background: as far beyond the threshold as the object's median lies before it. O(voxels) and the filter's time.
Status select(const Selection& selection, double sigma, Volume& volume, Threshold& threshold,
              const Workers& workers = Workers());

// Values of a label map but 0, in order. Fails beyond `most` values, or where a value is no whole number within
// 2^24, below which floats hold all of them.
Status find_labels(const Volume& volume, size_t most, std::vector<int32_t>& labels);

}  // namespace tool
