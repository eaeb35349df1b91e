// SPDX-License-Identifier: MIT
// whole_maps: the maps of several commits as those of a single one, from the state kept before (block/way_back.h) to
// the present mesh.
#pragma once

#include "block/context.h"

namespace tpa {

// Before the first commit: each element is its own origin. O(V).
void begin_whole_maps(Context& c);

// After a commit: adds its maps to the whole, and makes the identity of them. O(V).
void add_to_whole_maps(Workspace& w);

// After the last commit: publishes the whole, with true origins, and the changes since. O(V).
void publish_whole_maps(Workspace& w);

}  // namespace tpa
