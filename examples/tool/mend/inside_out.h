// SPDX-License-Identifier: MIT
// inside_out: parts of a closed mesh that are turned inside out, told from voids.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "tool/io/mesh_io.h"
#include "tool/topology.h"

namespace tool {

// A part is turned if its signed volume is clearly negative, and a corner of it has winding number 0 or less about all
// other parts: no outward part contains it, so that it encloses -1 or less. Voids lie in outward parts with all
// corners.
struct TurnedPart {
  size_t component = 0;  // in the order of parts_of()
  Part part;
};

struct InsideOut {
  std::vector<TurnedPart> turned;
  bool is_all = false;  // no part that lies in no other is outward
  double left_out = 0;  // what the turned parts enclose, as a positive volume
};

// Pre: closed, oriented. O(V log V) expected, where few parts are negative.
InsideOut find_inside_out(const TriangleMesh& mesh);

// Turns these parts, and the parts within that would no longer be a void or a body: within a part turned, parts
// alternate as they do in a part that was outward. Returns the number of parts turned.
size_t turn_parts(TriangleMesh& mesh, const InsideOut& found);

}  // namespace tool
