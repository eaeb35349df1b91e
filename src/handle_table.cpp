// handle_table: the rows of the database, evaluated by the compiler (paper section 4.2).
#include "handle_rows.h"

namespace tpa {

namespace {
template <u32 count>
using Indices = std::make_integer_sequence<u32, count>;
constexpr HandleRows<rows_for_two> two = make_rows<2>(Indices<rows_for_two>{});
constexpr HandleRows<rows_for_three> three = make_rows<3>(Indices<rows_for_three>{});
constexpr HandleRows<rows_for_four> four = make_rows<4>(Indices<rows_for_four>{});
}  // namespace

const HandleRow& handle_row(u32 k, const u32 (&sides)[max_handle_polygons]) {
  const u32 index = row_index(k, sides);
  return k == 2 ? two.at[index] : k == 3 ? three.at[index] : four.at[index];
}

}  // namespace tpa
