// SPDX-License-Identifier: MIT
// handle_table: the rows of the handle database for polygons of 3 to 15 sides (paper section 4.2, "we have
// computed handles for k = 2, 3, 4 and lambda <= 15"). The rows are evaluated by the compiler, and rest in
// read-only data.
#pragma once

#include "handles/alternating.h"

namespace tpa {

inline constexpr u32 shortest_polygon = 3;
inline constexpr u32 longest_tabled_polygon = 15;
// A build may leave out the rows of four polygons, two thirds of all.
#if defined(TPA_WITHOUT_QUADRUPLES)
inline constexpr u32 most_tabled_polygons = 3;
#else
inline constexpr u32 most_tabled_polygons = 4;
#endif
inline constexpr u32 row_capacity = 32;
inline constexpr u32 rows_for_two = 91, rows_for_three = 455, rows_for_four = 1820;

// The generators of one key, as codes for the functions below.
struct HandleRow {
  u16 code[row_capacity] = {};
  u8 count = 0;
  bool complete = false;
};

template <u32 count>
struct HandleRows {
  HandleRow at[count] = {};
};

// The rows of four polygons in four parts, so that no part takes a compiler long.
inline constexpr u32 rows_in_quarter = rows_for_four / 4;
using QuarterOfFour = HandleRows<rows_in_quarter>;
extern const QuarterOfFour quarter_of_four_0, quarter_of_four_1, quarter_of_four_2, quarter_of_four_3;

// The row of a key. Pre: k <= most_tabled_polygons; sides sorted, longest first, all from 3 to 15.
const HandleRow& handle_row(u32 k, const u32 (&sides)[max_handle_polygons]);

// Generators in words, for keys without alternating handles.
struct WordRow {
  PackedWords word[row_capacity] = {};
  u8 count = 0;
  bool complete = false;
};
// Null where the key has alternating handles, or k = 2. Pre: as for handle_row.
const WordRow* unequal_row(u32 k, const u32 (&sides)[max_handle_polygons]);
// The same by row_index: for k = 3, and for k = 4 in four parts, so that no part takes a compiler long. The parts begin
// with the first rows of polygons of 3, 9, 13 and 15 sides.
inline constexpr u32 first_unequal_of_four[] = {0, 126, 715, 1365, rows_for_four};
const WordRow* unequal_row_of_three(u32 index);
const WordRow* unequal_row_of_four_0(u32 index);
const WordRow* unequal_row_of_four_1(u32 index);
const WordRow* unequal_row_of_four_2(u32 index);
const WordRow* unequal_row_of_four_3(u32 index);

// Rows are in colexicographic order of the sides, sorted with the longest first.
constexpr u32 row_index(u32 k, const u32 (&sides)[max_handle_polygons]) {
  u32 index = 0;
  for (u32 i = 0; i < k; ++i) {
    const u32 choose = k - i;
    u64 ways = 1;
    for (u32 t = 0; t < choose; ++t) ways = ways * (sides[i] - shortest_polygon + t) / (t + 1);
    index += static_cast<u32>(ways);
  }
  return index;
}

struct RowSides {
  u32 sides[max_handle_polygons] = {};
};
constexpr RowSides sides_of_row(u32 k, u32 index) {
  RowSides row;
  for (u32 i = 0; i < k; ++i) {
    const u32 choose = k - i;
    u32 side = shortest_polygon;
    u64 below = 0;
    for (;; ++side) {  // `ways` multisets have this element smaller than `side` + 1
      u64 ways = 1;
      for (u32 t = 0; t < choose; ++t) ways = ways * (side + 1 - shortest_polygon + t) / (t + 1);
      if (ways > index) break;
      below = ways;
    }
    row.sides[i] = side;
    index -= static_cast<u32>(below);
  }
  return row;
}

// k = 2. The shorter polygon's steps divide the longer one's into runs of floor(p / q) or one more; the code
// has a bit for each run, set where it is the longer kind. Of all rotations the smallest number is kept.
constexpr WordHandle word_of_necklace(const u32 (&sides)[max_handle_polygons], u16 code) {
  WordHandle word;
  word.x_steps[0] = static_cast<u8>(sides[0]), word.y_steps[0] = static_cast<u8>(sides[1]);
  u32 bit = 0;
  for (u32 run = 0; run < sides[1]; ++run) {
    const u32 length = sides[0] / sides[1] + ((code >> run) & 1);
    for (u32 t = 0; t < length; ++t) word.steps |= u64{1} << bit++;
    ++bit;
  }
  return word;
}
constexpr u32 rotated_necklace(u32 code, u32 beads, u32 by) {
  return ((code >> by) | (code << (beads - by))) & ((1u << beads) - 1);
}
// The smallest number of runs by which the necklace may be rotated into itself.
constexpr u32 necklace_period(u32 code, u32 beads) {
  u32 by = 1;
  while (by < beads && rotated_necklace(code, beads, by) != code) ++by;
  return by;
}

// k = 3, 4. Alternating handles: plan, turns and free lengths.
constexpr u16 code_of(u32 k, const Alternating& handle) {
  return static_cast<u16>(handle.plan | handle.turns << 3 |
                          (k == 4 ? handle.length[0] << 7 | handle.length[1] << 11 : 0));
}
constexpr Alternating alternating_of(u32 k, const u32 (&sides)[max_handle_polygons], u16 code) {
  Alternating handle{static_cast<u8>(code & 7), static_cast<u8>((code >> 3) & 15), {}};
  const Plan& plan = plan_of(k, handle.plan);
  const LengthRule rule = length_rule(k, handle.plan, handle.turns, sides);
  solve_lengths(k, plan, rule, (code >> 7) & 15, (code >> 11) & 15, handle.length);
  return handle;
}

constexpr Alternating exchanged(u32 k, const Alternating& handle, u32 index) {
  const Exchange& exchange = exchange_of(k, handle.plan, index);
  const Plan& plan = plan_of(k, handle.plan);
  Alternating image{exchange.plan, 0, {}};
  for (u32 s = 0; s < plan.strips; ++s) image.length[exchange.strip(s)] = handle.length[s];
  for (u32 t = 0; t < plan.triangles; ++t)
    image.turns = static_cast<u8>(image.turns | ((handle.turns >> t) & 1) << exchange.triangle[t]);
  return image;
}

}  // namespace tpa
