// SPDX-License-Identifier: MIT
// passes: shorter edges where the mesh at rest leaves out voxels, as long as they gain.
#pragma once

#include "tool/segment/segmentation.h"

namespace tool {

// Looks at the mesh at rest. True: `s.edges` are shorter round the voxels that the next pass is to fill, which
// `missing` receives (nonzero), and `s.passes` has a line for the pass. Otherwise no pass is worth its work: the mesh
// encloses enough, the last pass filled too little, or no edge may become shorter. `missing` from the pass before.
bool begin_pass(Segmentation& s, std::vector<uint8_t>& missing);

// Completes the last line of `s.passes`. Afterwards `missing` has 1 for voxels still left out, 2 for those filled.
void end_pass(Segmentation& s, std::vector<uint8_t>& missing);

}  // namespace tool
