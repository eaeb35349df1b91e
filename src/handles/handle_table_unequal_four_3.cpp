// SPDX-License-Identifier: MIT
// handle_table_unequal_four_3: the rows of four polygons, with one of 15 sides, without alternating handles,
// evaluated by the compiler (paper section 4.2).
#include "handles/unequal.h"

namespace tpa {

namespace {

constexpr auto unequal_four_3_table = unequal_table<4, first_unequal_of_four[3], first_unequal_of_four[4]>();
static_assert(generators_in(unequal_four_3_table.row) == 1693);
static_assert(fingerprint(unequal_four_3_table) == 0x8a1c36454d2ea799u);

}  // namespace

const WordRow* unequal_row_of_four_3(u32 index) { return find_row(unequal_four_3_table, index); }

}  // namespace tpa
