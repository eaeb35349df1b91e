// SPDX-License-Identifier: MIT
// whole_components: what became of components in several commits, as if in a single one.
#pragma once

#include "block/context.h"

namespace tpa {

// Before the first commit: notes the components. O(V).
void note_first_components(Workspace& w);

// After the last commit, with the maps of the whole: relates components before and after by vertices and parents, fills
// w.parts with their families, and publishes the components before. The list of components is known. O(V).
void relate_first_components(Workspace& w);

}  // namespace tpa
