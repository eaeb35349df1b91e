// SPDX-License-Identifier: MIT
// region_volume: the volume that the mesh encloses.
#pragma once

#include "block/context.h"

namespace tpa {

// Voids taken off; with TPA_REGION_OUTSIDE the volume of the space left out. Measured from the mesh alone, since
// volumes followed through commits would depend on their history. O(V).
f64 volume_of_region(const Workspace& w, const Exec& exec);

}  // namespace tpa
