// SPDX-License-Identifier: MIT
// handles_made: how many handles an island has made, from the Euler characteristic of its edits and from the components
// that it joined. Islands that are done may have joined some of them before, so the transaction keeps disjoint sets of
// components (Component::joined): two bodies that meet in two places become one body with a handle.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// Each component is a set of its own. O(components).
void forget_joins(Components& c);
// Joins the components that the present island, now done, has joined. Expected O(edits of the island).
void note_joins(Transaction& t);

// The handles that the present island has made, less those that it has opened. Expected O(edits of the island).
i64 handles_made(Transaction& t);

}  // namespace tpa
