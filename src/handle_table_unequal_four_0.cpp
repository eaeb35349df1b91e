// handle_table_unequal_four_0: the rows of four polygons of up to 13 sides without alternating handles,
// evaluated by the compiler (paper section 4.2).
#include "handle_unequal.h"

namespace tpa {

namespace {

constexpr auto table = unequal_table<4, 0, first_long_four>();
static_assert(generators_in(table.row) == 3021);
static_assert(fingerprint(table) == 0x2de51018cf5f1058u);

}  // namespace

const WordRow* unequal_row_of_four_0(u32 index) { return find_row(table, index); }

}  // namespace tpa
