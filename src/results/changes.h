// SPDX-License-Identifier: MIT
// changes: sets of changed elements as ranges, few enough for a caller's array. Only reads the set.
#pragma once

#include "base/bit_set.h"
#include "topoadapt.h"

namespace tpa {

u32 count_members(const BitSet& set);

// The ranges that cover the set, ascending, across gaps of at most `gap` elements. The gap doubles until the ranges fit
// the capacity, at least 1. Returns their number. O(members) for each gap.
u32 list_ranges(const BitSet& set, u32 gap, tpa_range* ranges, u32 capacity);

}  // namespace tpa
