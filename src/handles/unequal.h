// SPDX-License-Identifier: MIT
// unequal: rows for keys without alternating handles (paper section 4.2). Only for files whose constants the compiler
// evaluates.
//
// Such keys have a longest polygon too long for three or four faces at every vertex; a few small keys belong to them,
// too.
#pragma once

#include "handles/ring.h"
#include "handles/small.h"

namespace tpa {

constexpr WordRow row_of_unequal(u32 k, u32 index) {
  const RowSides key = sides_of_row(k, index);
  WordBuilder builder;
  builder.k = k;
  builder.exchanges = permitted_exchanges(k, key.sides);
  gather_rings(k, key.sides, builder);
  if (builder.count == 0) gather_small(k, key.sides, builder);
  WordRow row;
  for (u32 i = 0; i < builder.count; ++i) row.word[i] = pack(builder.word[i]);
  row.count = static_cast<u8>(builder.count);
  row.complete = !builder.dropped;
  return row;
}

template <u32 k, u32 index>
inline constexpr WordRow word_row = row_of_unequal(k, index);

// Alternating handles exist at least this far from equality, so most keys need not be tried.
constexpr bool is_unequal(u32 k, u32 index) {
  const RowSides key = sides_of_row(k, index);
  return key.sides[0] + 5 >= key.sides[1] + key.sides[2] + key.sides[3] && row_of_more(k, index).count == 0;
}
template <u32 k, u32 index>
inline constexpr bool unequal_key = is_unequal(k, index);

// The indices of the unequal keys in a range of a k's rows, in order.
struct UnequalKeys {
  u16 index[256] = {};
  u32 count = 0;
};
template <u32 k, u32 first, u32... indices>
constexpr UnequalKeys find_unequal(Indices<indices...>) {
  constexpr bool unequal[] = {unequal_key<k, first + indices>...};
  UnequalKeys keys;
  for (u32 i = 0; i < sizeof...(indices); ++i)
    if (unequal[i]) keys.index[keys.count++] = static_cast<u16>(first + i);
  return keys;
}
template <u32 k, u32 first, u32 end>
inline constexpr UnequalKeys unequal_keys = find_unequal<k, first>(IndicesUpTo<end - first>{});

template <u32 rows>
struct UnequalTable {
  u16 index[rows] = {};
  WordRow row[rows] = {};
};
template <u32 k, const UnequalKeys& keys, u32... places>
constexpr UnequalTable<keys.count> make_unequal(Indices<places...>) {
  return {{keys.index[places]...}, {word_row<k, keys.index[places]>...}};
}
// The unequal rows of k polygons with indices from `first` to `end`.
template <u32 k, u32 first, u32 end>
constexpr auto unequal_table() {
  return make_unequal<k, unequal_keys<k, first, end>>(IndicesUpTo<unequal_keys<k, first, end>.count>{});
}

// Bisection.
template <u32 rows>
const WordRow* find_row(const UnequalTable<rows>& table, u32 index) {
  u32 low = 0, high = rows;
  while (low < high) {
    const u32 middle = (low + high) / 2;
    if (table.index[middle] < index)
      low = middle + 1;
    else
      high = middle;
  }
  return low < rows && table.index[low] == index ? &table.row[low] : nullptr;
}

template <u32 rows>
constexpr u64 fingerprint(const UnequalTable<rows>& table) {
  u64 hash = mix_basis;
  for (u32 i = 0; i < rows; ++i) {
    const WordRow& r = table.row[i];
    hash = mix(mix(hash, table.index[i]), r.count + (r.complete ? 256u : 0u));
    for (u32 g = 0; g < r.count; ++g) {
      hash = mix(mix(hash, r.word[g].steps), r.word[g].plan);
      for (u8 steps : r.word[g].steps_of_strip) hash = mix(hash, steps);
    }
  }
  return hash;
}

}  // namespace tpa
