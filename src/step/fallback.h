// SPDX-License-Identifier: MIT
// fallback: the advice of a failed attempt to the next. Vertices in contact are left at their old places, in a growing
// zone.
#pragma once

#include "step/attempt.h"

namespace tpa {

// Marks the vertices of all faces still in contact as newly frozen.
void give_way_at_contacts(Attempt& a);

// Freezes newly frozen vertices and `rings` rings of neighbours round them; `whole_mesh` freezes all vertices. Pre: the
// mesh is as it was before the transaction.
void grow_frozen(Workspace& w, u32 rings);

}  // namespace tpa
