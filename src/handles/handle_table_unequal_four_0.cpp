// SPDX-License-Identifier: MIT
// handle_table_unequal_four_0: the rows of four polygons, of up to 8 sides, without alternating handles,
// evaluated by the compiler (paper section 4.2).
#include "handles/unequal.h"

namespace tpa {

namespace {

constexpr auto unequal_four_0_table = unequal_table<4, first_unequal_of_four[0], first_unequal_of_four[1]>();
static_assert(generators_in(unequal_four_0_table.row) == 240);
static_assert(fingerprint(unequal_four_0_table) == 0xe0ef44d4c4a95e55u);

}  // namespace

const WordRow* unequal_row_of_four_0(u32 index) { return find_row(unequal_four_0_table, index); }

}  // namespace tpa
