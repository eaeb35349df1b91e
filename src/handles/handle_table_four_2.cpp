// SPDX-License-Identifier: MIT
// handle_table_four_2: the third quarter of the rows of four polygons, evaluated by the compiler (paper
// section 4.2).
#include "handles/rows.h"

namespace tpa {

constexpr QuarterOfFour quarter_of_four_2 = rows_from<4, 2 * rows_in_quarter, rows_in_quarter>();
static_assert(generators_in(quarter_of_four_2.at) == 13109);
static_assert(fingerprint(quarter_of_four_2) == 0x63c4b6bf7f2bdd7fu);

}  // namespace tpa
