// SPDX-License-Identifier: MIT
// doubles: polygons that a file holds more than once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tool/io/polygon_mesh.h"

namespace tool {

// Of polygons with the same corners in turn, forwards or backwards, one stays where the edges round them close by it,
// and did not before: the copy that winds as its neighbours do, else the first. Doubles that edges connect go or stay
// together, so that surfaces in balance, such as bodies back to back, keep theirs. `source` has n - 2 entries for each
// polygon of n corners. Returns how many have gone. O(n log n) expected.
size_t drop_doubles(PolygonMesh& mesh, std::vector<uint32_t>& source);

}  // namespace tool
