// SPDX-License-Identifier: MIT
// handle_table_unequal_three: the rows of three polygons without alternating handles, evaluated by the
// compiler (paper section 4.2).
#include "handles/unequal.h"

namespace tpa {

namespace {

constexpr auto unequal_three_table = unequal_table<3, 0, rows_for_three>();
static_assert(generators_in(unequal_three_table.row) == 4269);
static_assert(fingerprint(unequal_three_table) == 0x366b0a129fefae84u);

}  // namespace

const WordRow* unequal_row_of_three(u32 index) { return find_row(unequal_three_table, index); }

}  // namespace tpa
