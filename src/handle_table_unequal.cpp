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

template <u32 count>
struct Masks {
  u32 at[count];
};
template <u32 k, u32... indices>
constexpr Masks<sizeof...(indices)> make_masks(std::integer_sequence<u32, indices...>) {
  return {{surplus_mask_of<k, indices>...}};
}
constexpr Masks<rows_for_three> masks_of_three =
    make_masks<3>(std::make_integer_sequence<u32, rows_for_three>{});
constexpr Masks<rows_for_four> masks_of_four =
    make_masks<4>(std::make_integer_sequence<u32, rows_for_four>{});

// The same bits from every compiler; see handle_table.cpp.
constexpr u64 mix(u64 hash, u64 value) { return (hash ^ value) * 0x100000001b3; }
constexpr u64 fingerprint(const WordRows& all) {
  u64 hash = 0xcbf29ce484222325;
  for (const WordRow& r : all.at) {
    hash = mix(hash, r.count + (r.complete ? 256u : 0u));
    for (u32 i = 0; i < r.count; ++i) {
      hash = mix(hash, r.word[i].steps);
      for (u32 s = 0; s < 3; ++s) hash = mix(hash, r.word[i].x_steps[s] * 16u + r.word[i].y_steps[s]);
    }
  }
  return hash;
}
constexpr u64 fingerprint(const Masks<rows_for_three>& three, const Masks<rows_for_four>& four) {
  u64 hash = 0xcbf29ce484222325;
  for (u32 mask : three.at) hash = mix(hash, mask);
  for (u32 mask : four.at) hash = mix(hash, mask);
  return hash;
}
constexpr u32 generators_in(const WordRows& all) {
  u32 sum = 0;
  for (const WordRow& r : all.at) sum += r.count;
  return sum;
}
static_assert(generators_in(rows) == 1155);
static_assert(fingerprint(rows) == 0x9d55efe386bf7caau);
static_assert(fingerprint(masks_of_three, masks_of_four) == 0xb96f1511d8cae72u);

}  // namespace

u32 surplus_mask(u32 k, const u32 (&sides)[max_handle_polygons]) {
  const u32 index = row_index(k, sides);
  return k == 3 ? masks_of_three.at[index] : masks_of_four.at[index];
}

const WordRow* unequal_row(u32 k, const u32 (&sides)[max_handle_polygons]) {
  if (k != 3 || sides[0] > longest_searched_polygon) return nullptr;
  const u8 place = unequal.place[row_index(k, sides)];
  return place == 0xFF ? nullptr : &rows.at[place];
}

}  // namespace tpa
