// SPDX-License-Identifier: MIT
// component_events: merge, split, change of genus and death of components, as events (section 2).
#pragma once

#include "block/context.h"

namespace tpa {

// The number of events that the families tell of.
u64 count_component_events(const Parts& parts);

// After the commit of the parts: adds these events. Pre: there is room.
void add_component_events(Workspace& w);

}  // namespace tpa
