// SPDX-License-Identifier: MIT
// swallowed: components that bound no part of the region, in contact or not (section 2, "enclosed" objects).
#pragma once

#include "islands/attempt.h"

namespace tpa {

// Before the first edit, in tpa_adapt: removes components of two triangles back to back, impossible in a mesh free of
// contacts. O(F).
void drop_back_to_back(Transaction& t);

// After all islands: removes components that bound no part of the region of winding number >= 1. tpa_adapt removes all
// such components, a step only those made or turned inside out during the step. O(edits) where cheap proofs tell that
// all components bound something, else O(V).
void drop_swallowed(Transaction& t);

}  // namespace tpa
