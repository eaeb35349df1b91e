// SPDX-License-Identifier: MIT
// part_volumes: the volumes of parts after a transaction (section 2), from the volumes of components before and the
// changed faces. So the cost of a step with few changed faces stays small.
#pragma once

#include "mesh/component_changes.h"

namespace tpa {

// Fills volume and size of the parts. Call after find_parts(), when all edits are done, and before the commit. A volume
// stays unknown if a component of the family had no known volume. O(elements visited by find_parts()).
void measure_parts(const Edit& e, Components& before, Parts& p);

}  // namespace tpa
