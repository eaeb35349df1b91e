// SPDX-License-Identifier: MIT
// handle_table_unequal_four_1: the rows of four polygons, with a longest one of 9 to 12 sides, without alternating
// handles, evaluated by the compiler (paper section 4.2).
#include "handles/unequal.h"

namespace tpa {

namespace {

constexpr auto unequal_four_1_table = unequal_table<4, first_unequal_of_four[1], first_unequal_of_four[2]>();
static_assert(generators_in(unequal_four_1_table.row) == 1806);
static_assert(fingerprint(unequal_four_1_table) == 0xbf760cd35014c3a2u);

}  // namespace

const WordRow* unequal_row_of_four_1(u32 index) { return find_row(unequal_four_1_table, index); }

}  // namespace tpa
