// SPDX-License-Identifier: MIT
// handle_table_four_1: the second quarter of the rows of four polygons, evaluated by the compiler (paper
// section 4.2).
#include "handles/rows.h"

namespace tpa {

constexpr QuarterOfFour quarter_of_four_1 = rows_from<4, 1 * rows_in_quarter, rows_in_quarter>();
static_assert(generators_in(quarter_of_four_1.at) == 12419);
static_assert(fingerprint(quarter_of_four_1) == 0xd8121796ae59ea63u);

}  // namespace tpa
