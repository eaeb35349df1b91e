// SPDX-License-Identifier: MIT
// handle_table_four_3: the last quarter of the rows of four polygons, evaluated by the compiler (paper
// section 4.2).
#include "handles/rows.h"

namespace tpa {

constexpr QuarterOfFour quarter_of_four_3 = rows_from<4, 3 * rows_in_quarter, rows_in_quarter>();
static_assert(generators_in(quarter_of_four_3.at) == 12759);
static_assert(fingerprint(quarter_of_four_3) == 0xd4bb5da278f904b3u);

}  // namespace tpa
