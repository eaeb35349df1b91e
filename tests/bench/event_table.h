// SPDX-License-Identifier: MIT
// event_table: what one topological event adds to a step.
#pragma once

#include <cstdint>

namespace bench {

// Prints a row for each size of mesh between the two, for a tip that goes so many edges beyond what it meets.
void EventTable(uint32_t least, uint32_t most, int repeats, double beyond);

}  // namespace bench
