// handle_table_unequal_four_0: the rows of four polygons, of up to 8 sides, without alternating handles,
// evaluated by the compiler (paper section 4.2).
#include "handles/unequal.h"

namespace tpa {

namespace {

constexpr auto table = unequal_table<4, first_unequal_of_four[0], first_unequal_of_four[1]>();
static_assert(generators_in(table.row) == 240);
static_assert(fingerprint(table) == 0xe0ef44d4c4a95e55u);

}  // namespace

const WordRow* unequal_row_of_four_0(u32 index) { return find_row(table, index); }

}  // namespace tpa
