// SPDX-License-Identifier: MIT
// space_order: new numbers for vertices and faces, along a curve through space. Elements near in space then lie near in
// memory, wherever edits have put them.
#pragma once

#include "block/context.h"

namespace tpa {

// Renumbers the mesh of the context: a commit that changes nothing but numbers. Drops targets. Pre: a mesh is loaded.
// O(V).
void order_by_space(Context& c);

}  // namespace tpa
