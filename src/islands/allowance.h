// SPDX-License-Identifier: MIT
// allowance: how much an island may use, whatever the limits. Each way, the paper's and the exact cut, first shows its
// wants: contacts at the first detection, elements and pieces in the first pass. Later passes and attempts mostly want
// less; an attempt that wants several times as much is given up. So limits that suffice never change a result.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// Is this much within the limit (TPA_LIMIT_...) and the allowance? Fills in the issue if the limit fails the call.
Outcome check_amount(Attempt& a, i32 limit, u64 wanted, u64 allowed, u64 available);

// From now on the attempt uses slots of vertices and triangles within the allowance of its way only.
void allow_elements(Attempt& a);
// Sets the allowance of the attempt's way, unless known: so many slots are wanted in the first pass.
void note_elements(Attempt& a, u64 vertices, u64 triangles);
// The allowed slots of vertices, or of triangles, have run out.
Outcome out_of_vertices(Attempt& a);
Outcome out_of_triangles(Attempt& a);
// Room for an exact cut has run out; so many pieces are enough for the rest of the call.
Outcome out_of_pieces(Attempt& a, u64 enough);

}  // namespace tpa
