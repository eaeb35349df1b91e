// handle_table_unequal_four_1: the rows of four polygons, one of 14 or 15 sides, without alternating handles,
// evaluated by the compiler (paper section 4.2).
#include "handle_unequal.h"

namespace tpa {

namespace {

constexpr auto table = unequal_table<4, first_long_four, rows_for_four>();
static_assert(generators_in(table.row) == 2976);
static_assert(fingerprint(table) == 0x2e24d06b7dd48680u);

}  // namespace

const WordRow* unequal_row_of_four_1(u32 index) { return find_row(table, index); }

}  // namespace tpa
