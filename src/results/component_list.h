// SPDX-License-Identifier: MIT
// component_list: the components of the mesh as callers see them. Only reads the context.
#pragma once

#include "block/context.h"

namespace tpa {

// Measures all components, in the order of their ids. `list` has a place for each. O(V + F).
void list_components(const Context& c, const Components& known, tpa_component* list);

}  // namespace tpa
