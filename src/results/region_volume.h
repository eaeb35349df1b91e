// SPDX-License-Identifier: MIT
// region_volume: the volume that the mesh encloses, as a sum over groups of blocks of faces. A commit forgets the sums
// that it has changed, and the next question measures these alone. The result depends on the mesh, not on its history.
#pragma once

#include "block/context.h"

namespace tpa {

// In a commit, behind note_changes(): forgets the sums with faces changed, made, or moved. O(changes), and O(1) for
// faces that are gone.
void forget_volumes(Context& c, const Mesh& m);

// Voids taken off; with TPA_REGION_OUTSIDE the volume of the space left out. O(faces in forgotten blocks, and groups).
f64 volume_of_region(const Workspace& w, const Exec& exec);

}  // namespace tpa
