// disjoint_sets: which of some numbers belong together, in an array in which each names another one of its set, and one
// itself. With path halving (Tarjan & van Leeuwen 1984); the least of a set names it, so names do not depend on the order
// of the joins.
#pragma once

#include "base.h"

namespace tpa {

// The number that names the set of i. Nearly O(1).
u32 find_set(u32* parent, u32 i);
void join_sets(u32* parent, u32 a, u32 b);

}  // namespace tpa
