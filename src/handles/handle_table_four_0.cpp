// SPDX-License-Identifier: MIT
// handle_table_four_0: the first quarter of the rows of four polygons, evaluated by the compiler (paper
// section 4.2).
#include "handles/rows.h"

namespace tpa {

constexpr QuarterOfFour quarter_of_four_0 = rows_from<4, 0 * rows_in_quarter, rows_in_quarter>();
static_assert(generators_in(quarter_of_four_0.at) == 10151);
static_assert(fingerprint(quarter_of_four_0) == 0x46870a5dd982e70eu);

}  // namespace tpa
