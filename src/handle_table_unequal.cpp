// handle_table_unequal: rows of keys too unequal for alternating handles, evaluated by the compiler
// (section 4.2).
#include "handle_unequal.h"

namespace tpa {

namespace {

// Where the triples with a longest side of `longest_searched_polygon` end.
constexpr u32 searched_rows =
    (longest_searched_polygon - 2) * (longest_searched_polygon - 1) * longest_searched_polygon / 6;

constexpr bool is_unequal(u32 index) {
  const RowSides key = sides_of_row(3, index);
  return key.sides[0] + 2 > key.sides[1] + key.sides[2];
}

// A row's place among those that are stored.
struct UnequalIndex {
  u8 place[searched_rows] = {};
  u8 row[searched_rows] = {};
  u32 count = 0;
};
constexpr UnequalIndex make_index() {
  UnequalIndex index;
  for (u32 i = 0; i < searched_rows; ++i) {
    index.place[i] = 0xFF;
    if (!is_unequal(i)) continue;
    index.row[index.count] = static_cast<u8>(i);
    index.place[i] = static_cast<u8>(index.count++);
  }
  return index;
}
constexpr UnequalIndex unequal = make_index();

struct WordRows {
  WordRow at[unequal.count];
};
template <u32... places>
constexpr WordRows make_word_rows(std::integer_sequence<u32, places...>) {
  return {{word_row<3, unequal.row[places]>...}};
}
constexpr WordRows rows = make_word_rows(std::make_integer_sequence<u32, unequal.count>{});

}  // namespace

const WordRow* unequal_row(u32 k, const u32 (&sides)[max_handle_polygons]) {
  if (k != 3 || sides[0] > longest_searched_polygon) return nullptr;
  const u8 place = unequal.place[row_index(k, sides)];
  return place == 0xFF ? nullptr : &rows.at[place];
}

}  // namespace tpa
