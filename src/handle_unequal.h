// handle_unequal: rows for keys whose polygons are too unequal for alternating handles (paper section 4.2).
// Included only where the compiler evaluates it.
//
// The words of a row come in order of their strips' unevenness, then of their lengths, then of the words
// themselves (an x-step before a y-step); the row ends after 32. All lengths are tried, so a row that holds
// fewer is complete.
#pragma once

#include "handle_rows.h"
#include "handle_search.h"

namespace tpa {

inline constexpr u32 length_capacity = 192;

struct StripLengths {
  u64 value = 0;  // unevenness
  u8 plan = 0;
  i8 p[max_plan_strips] = {}, q[max_plan_strips] = {};
};

struct LengthList {
  StripLengths at[length_capacity] = {};
  u32 count = 0;
  bool dropped = false;
};

constexpr i32 compare(const StripLengths& a, const StripLengths& b) {
  if (a.value != b.value) return a.value < b.value ? -1 : 1;
  if (a.plan != b.plan) return a.plan < b.plan ? -1 : 1;
  for (u32 s = 0; s < max_plan_strips; ++s) {
    if (a.p[s] != b.p[s]) return a.p[s] < b.p[s] ? -1 : 1;
    if (a.q[s] != b.q[s]) return a.q[s] < b.q[s] ? -1 : 1;
  }
  return 0;
}

// Keeps the list in order and free of doubles.
constexpr void enter_lengths(LengthList& list, const StripLengths& lengths) {
  u32 at = list.count;
  while (at > 0 && compare(lengths, list.at[at - 1]) < 0) --at;
  if (at > 0 && compare(lengths, list.at[at - 1]) == 0) return;
  if (list.count == length_capacity) {
    list.dropped = true;
    if (at == list.count) return;
  } else {
    ++list.count;
  }
  for (u32 i = list.count - 1; i > at; --i) list.at[i] = list.at[i - 1];
  list.at[at] = lengths;
}

// Enters the lengths that `search` holds, unless a lower bound of their cost rules them out.
template <class Found>
constexpr void offer_lengths(HandleSearch<Found>& search, LengthList& list) {
  place_strips(search);
  i32 least = search.spent;
  const Plan& plan = *search.plan;
  StripLengths lengths;
  lengths.value = is_crowded(plan) ? crowding : 0;
  lengths.plan = search.word.plan;
  for (u32 s = 0; s < plan.strips; ++s) {
    least += least_cost_ahead(search, s);
    lengths.p[s] = static_cast<i8>(search.p[s]), lengths.q[s] = static_cast<i8>(search.q[s]);
    lengths.value += static_cast<u64>((search.p[s] + search.q[s]) * (search.p[s] + search.q[s]));
  }
  if (least <= search.target) enter_lengths(list, lengths);
}

// All lengths of the plan, strip by strip.
template <class Found>
constexpr void offer_all(HandleSearch<Found>& search, u32 s, i32 (&left)[max_handle_polygons], i32 allowance,
                         LengthList& list) {
  const Plan& plan = *search.plan;
  if (s == plan.strips) return offer_lengths(search, list);
  const u32 x = plan.x[s], y = plan.y[s];
  bool last_of_x = true, last_of_y = true;
  for (u32 z = s + 1; z < plan.strips; ++z) {
    last_of_x = last_of_x && plan.x[z] != x && plan.y[z] != x;
    last_of_y = last_of_y && plan.x[z] != y && plan.y[z] != y;
  }
  for (i32 p = last_of_x ? left[x] : 0; p <= left[x]; ++p)
    for (i32 q = max_of(last_of_y ? left[y] : 0, p - 1 - allowance); q <= min_of(left[y], p + 1 + allowance);
         ++q) {
      search.p[s] = p, search.q[s] = q;
      left[x] -= p, left[y] -= q;
      offer_all(search, s + 1, left, allowance - least_strip_cost(p, q), list);
      left[x] += p, left[y] += q;
    }
}

template <class Found>
constexpr void set_lengths(HandleSearch<Found>& search, u32 plan) {
  search.plan = &plan_of(search.k, plan);
  search.word = {};
  search.word.plan = static_cast<u8>(plan);
  search.bit = 0;
}

constexpr bool is_generator(u32 k, const WordHandle& word, const ExchangeList& list) {
  for (u32 i = 0; i < list.count; ++i)
    if (compare(exchanged(k, word, list.index[i]), word) < 0) return false;
  return true;
}

// What a handle costs at least where the longest polygon has `surplus` vertices too many for an alternating
// handle.
constexpr i32 least_target(u32 k, const u32 (&sides)[max_handle_polygons]) {
  const i32 others = static_cast<i32>(sides[1] + sides[2] + sides[3]);
  return max_of(0, static_cast<i32>(sides[0]) - others + 2 * (static_cast<i32>(k) - 2));
}

constexpr WordRow row_of_unequal(u32 k, u32 index) {
  const RowSides key = sides_of_row(k, index);
  const ExchangeList exchanges_of_key = permitted_exchanges(k, key.sides);
  WordRow row;
  bool dropped = false;
  const auto found = [&](const WordHandle& word) {
    if (!is_generator(k, word, exchanges_of_key)) return true;
    if (row.count == row_capacity)
      dropped = true;
    else
      row.word[row.count++] = word;
    return !dropped;
  };
  for (i32 target = least_target(k, key.sides); row.count == 0; ++target) {
    LengthList list;
    HandleSearch<decltype(found)> search{k, key.sides, target, found};
    for (u32 plan = 0; plan < plan_count(k); ++plan) {
      set_lengths(search, plan);
      i32 left[max_handle_polygons] = {};
      for (u32 p = 0; p < k; ++p) left[p] = static_cast<i32>(key.sides[p]);
      offer_all(search, 0, left, target, list);
    }
    for (u32 i = 0; i < list.count && !dropped; ++i) {
      set_lengths(search, list.at[i].plan);
      for (u32 s = 0; s < max_plan_strips; ++s) search.p[s] = list.at[i].p[s], search.q[s] = list.at[i].q[s];
      search_lengths(search);
    }
    row.complete = !dropped && !list.dropped;
  }
  return row;
}

// The sum over the vertices of e (e - 1) / 2, e being the number of faces less three.
constexpr i32 handle_cost(u32 k, const u32 (&sides)[max_handle_polygons], const EvenHandle& handle) {
  const Plan& plan = plan_of(k, handle.plan);
  i32 e[max_handle_polygons][searched_side] = {};
  i32 cost = 0;
  for (u32 x = 0; x < k; ++x)
    for (u32 v = 0; v < sides[x]; ++v) e[x][v] = -1;
  u32 at[max_handle_polygons] = {};
  u32 start[max_handle_polygons][max_plan_strips] = {};
  for (u32 x = 0; x < k; ++x)
    for (u32 t = 0; t < plan.degree[x]; ++t) {
      const u32 s = plan.around[x][t];
      start[x][s] = at[x];
      ++e[x][at[x] % sides[x]];
      at[x] += plan.x[s] == x ? handle.strip[s].x_steps : handle.strip[s].y_steps;
    }
  for (u32 s = 0; s < plan.strips; ++s) {
    const EvenStrip& strip = handle.strip[s];
    const u32 x = plan.x[s], y = plan.y[s];
    for (u32 i = 0, j = 0; i < strip.x_steps || j < strip.y_steps;) {
      if (even_step_is_x(strip, i, j))
        ++e[y][(start[y][s] + strip.y_steps - j) % sides[y]], ++i;
      else
        ++e[x][(start[x][s] + i) % sides[x]], ++j;
    }
  }
  for (u32 x = 0; x < k; ++x)
    for (u32 v = 0; v < sides[x]; ++v) cost += e[x][v] * (e[x][v] - 1) / 2;
  return cost;
}

constexpr u32 make_surplus_mask(u32 k, u32 index) {
  const RowSides key = sides_of_row(k, index);
  // Alternating handles exist at least this far from equality, so that most keys need not be tried.
  if (key.sides[0] + 5 < key.sides[1] + key.sides[2] + key.sides[3] || row_of_more(k, index).count > 0)
    return 0;
  RowSides base = key;
  HandleRow row;
  do --base.sides[0], row = row_of_more(k, row_index(k, base.sides));
  while (row.count == 0);
  i32 least = INT32_MAX;
  u32 mask = 0;
  for (u32 g = 0; g < row.count; ++g) {
    EvenHandle handle = to_even(k, alternating_of(k, base.sides, row.code[g]));
    add_surplus(k, 0, key.sides[0] - base.sides[0], handle);
    const i32 cost = handle_cost(k, key.sides, handle);
    if (cost < least) least = cost, mask = 0;
    if (cost == least) mask |= 1u << g;
  }
  return mask;
}
template <u32 k, u32 index>
inline constexpr u32 surplus_mask_of = make_surplus_mask(k, index);

template <u32 k, u32 index>
inline constexpr WordRow word_row = row_of_unequal(k, index);

}  // namespace tpa
