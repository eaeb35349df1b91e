// SPDX-License-Identifier: MIT
// handle_table: the rows of two and of three polygons, evaluated by the compiler, and where to look for all
// rows (paper section 4.2).
#include "handles/rows.h"

namespace tpa {

namespace {

constexpr HandleRows<rows_for_two> two = rows_from<2, 0, rows_for_two>();
static_assert(generators_in(two.at) == 332);
static_assert(fingerprint(two) == 0x90336377db4efe34u);

constexpr HandleRows<rows_for_three> three = rows_from<3, 0, rows_for_three>();
static_assert(generators_in(three.at) == 518);
static_assert(fingerprint(three) == 0xea1463da7a683dc7u);

}  // namespace

const HandleRow& handle_row(u32 k, const u32 (&sides)[max_handle_polygons]) {
  const u32 index = row_index(k, sides);
  if constexpr (most_tabled_polygons == 4)
    if (k == 4) {
      const u32 quarter = index / rows_in_quarter;
      const QuarterOfFour& rows = quarter == 0   ? quarter_of_four_0
                                  : quarter == 1 ? quarter_of_four_1
                                  : quarter == 2 ? quarter_of_four_2
                                                 : quarter_of_four_3;
      return rows.at[index % rows_in_quarter];
    }
  return k == 2 ? two.at[index] : three.at[index];
}

const WordRow* unequal_row(u32 k, const u32 (&sides)[max_handle_polygons]) {
  const u32 index = row_index(k, sides);
  if constexpr (most_tabled_polygons == 4)
    if (k == 4) {
      if (index < first_unequal_of_four[1]) return unequal_row_of_four_0(index);
      if (index < first_unequal_of_four[2]) return unequal_row_of_four_1(index);
      return index < first_unequal_of_four[3] ? unequal_row_of_four_2(index) : unequal_row_of_four_3(index);
    }
  return k == 2 ? nullptr : unequal_row_of_three(index);
}

}  // namespace tpa
