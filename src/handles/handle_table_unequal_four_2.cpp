// SPDX-License-Identifier: MIT
// handle_table_unequal_four_2: the rows of four polygons, with a longest one of 13 or 14 sides, without alternating
// handles, evaluated by the compiler (paper section 4.2).
#include "handles/unequal.h"

namespace tpa {

namespace {

constexpr auto unequal_four_2_table = unequal_table<4, first_unequal_of_four[2], first_unequal_of_four[3]>();
static_assert(generators_in(unequal_four_2_table.row) == 2258);
static_assert(fingerprint(unequal_four_2_table) == 0x46c5fbdda95eadaeu);

}  // namespace

const WordRow* unequal_row_of_four_2(u32 index) { return find_row(unequal_four_2_table, index); }

}  // namespace tpa
