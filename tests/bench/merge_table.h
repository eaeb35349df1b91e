// SPDX-License-Identifier: MIT
// merge_table: two spheres that move into each other; what a step costs, by complete detection and
// by the vertex hash with cells of an edge, and how large its events are.
#pragma once

#include <cstdint>
#include <string_view>

namespace bench {

// `remeshing`: "no", "yes", or empty for both; `repeats`: times that each step is run.
void MergeTable(uint32_t least, uint32_t most, std::string_view remeshing, int repeats);

}  // namespace bench
