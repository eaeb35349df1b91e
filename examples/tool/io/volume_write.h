// SPDX-License-Identifier: MIT
// volume_write: label maps to files, in the grid of a volume that was read: NIfTI-1 (.nii, .nii.gz) or NRRD (.nrrd,
// compressed where the build has zlib).
#pragma once

#include <vector>

#include "tool/io/volume.h"

namespace tool {

// Fails if write_labels would surely fail: format, library or folder missing, no right to write. Writes nothing.
Status check_labels_output(const std::string& path);

// One label for each voxel of `grid`, in as few bytes as the labels need. NIfTI's world is RAS: a grid in LPS is
// turned, and a grid of no named space counts as RAS.
Status write_labels(const std::string& path, const Volume& grid, const std::vector<int32_t>& labels);

}  // namespace tool
