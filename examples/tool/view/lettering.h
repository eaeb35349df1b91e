// SPDX-License-Identifier: MIT
// lettering: shapes of letters as strokes. A stroke is a row of points, each a digit across and a digit up; letters
// stand on 2, are 8 high, and reach down to 0.
#pragma once

#include <string_view>

namespace tool {

// Strokes parted by blanks; empty for a blank or an unknown letter.
std::string_view strokes_of(char letter);

}  // namespace tool
