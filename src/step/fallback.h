// SPDX-License-Identifier: MIT
// fallback: the advice of a failed attempt to the next. An open piece is cut out more widely, then left at its old
// place, in a growing zone.
#pragma once

#include "step/attempt.h"

namespace tpa {

// Marks vertices round an open piece for the next attempt. After a first attempt with halved faces: no face of the
// group is halved again. While attempts widen: the vertices `open`, or all vertices just outside the loops if there are
// none, are taken along. While attempts cap: the whole group is frozen.
void give_way(Attempt& a, const Piece& piece, Span<const u32> open);

// Marks the vertices of all faces still in contact: frozen in a step, taken along in tpa_adapt.
void give_way_at_contacts(Attempt& a);

// Freezes newly frozen vertices and `rings` rings of neighbours round them; `whole_mesh` freezes all vertices. Pre: the
// mesh is as it was before the transaction.
void grow_frozen(Workspace& w, u32 rings);

}  // namespace tpa
