// handle_table_unequal_four_3: the rows of four polygons, with one of 15 sides, without alternating handles,
// evaluated by the compiler (paper section 4.2).
#include "handles/unequal.h"

namespace tpa {

namespace {

constexpr auto table = unequal_table<4, first_unequal_of_four[3], first_unequal_of_four[4]>();
static_assert(generators_in(table.row) == 1693);
static_assert(fingerprint(table) == 0x8a1c36454d2ea799u);

}  // namespace

const WordRow* unequal_row_of_four_3(u32 index) { return find_row(table, index); }

}  // namespace tpa
