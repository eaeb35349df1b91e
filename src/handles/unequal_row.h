// SPDX-License-Identifier: MIT
// unequal_row: the common part of the makers of rows of words (paper section 4.2). Only for files whose constants the
// compiler evaluates.
//
// Generators come in order of unevenness, then of compare() in handles/exchange.h: plan, lengths of the strips, words
// as numbers. The last generators fall off the end of a full row.
#pragma once

#include "handles/rows.h"

namespace tpa {

// Cost of a vertex with e + 3 faces; see handles/ring.h.
constexpr i32 vertex_cost(i32 e) { return e * (e - 1) / 2; }

constexpr bool is_generator(u32 k, const WordHandle& word, const ExchangeList& list) {
  for (u32 i = 0; i < list.count; ++i)
    if (compare(exchanged(k, word, list.index[i]), word) < 0) return false;
  return true;
}

// A plan that some exchange turns into an earlier plan has no generators.
constexpr bool plan_has_generators(u32 k, u32 plan, const ExchangeList& list) {
  for (u32 i = 0; i < list.count; ++i)
    if (exchange_of(k, plan, list.index[i]).plan < plan) return false;
  return true;
}

// A row of words under construction, like RowBuilder for codes.
struct WordBuilder {
  u32 k = 0;
  ExchangeList exchanges;
  WordHandle word[row_capacity] = {};
  u64 value[row_capacity] = {};
  u32 count = 0;
  bool dropped = false;
};

constexpr void insert(WordBuilder& row, const WordHandle& word, u64 value) {
  u32 at = row.count;
  while (at > 0 && (value < row.value[at - 1] || (value == row.value[at - 1] && compare(word, row.word[at - 1]) < 0)))
    --at;
  if ((at == row_capacity && row.dropped) || !is_generator(row.k, word, row.exchanges)) return;
  row.dropped = row.dropped || row.count == row_capacity;
  if (at == row_capacity) return;
  if (row.count < row_capacity) ++row.count;
  for (u32 i = row.count - 1; i > at; --i) row.word[i] = row.word[i - 1], row.value[i] = row.value[i - 1];
  row.word[at] = word, row.value[at] = value;
}

constexpr u64 unevenness(const Plan& plan, const WordHandle& word) {
  u64 sum = is_crowded(plan) ? crowding : 0;
  for (u32 s = 0; s < plan.strips; ++s) {
    const u64 n = u64{word.x_steps[s]} + word.y_steps[s];
    sum += n * n;
  }
  return sum;
}

// Does no edge occur twice? Only strips that go all round a polygon, and twin strips, can repeat an edge.
constexpr bool edges_differ(u32 k, const u32 (&sides)[max_handle_polygons], const WordHandle& word) {
  const Plan& plan = plan_of(k, word.plan);
  u32 x_steps[6] = {}, y_steps[6] = {};
  for (u32 s = 0; s < plan.strips; ++s) x_steps[s] = word.x_steps[s], y_steps[s] = word.y_steps[s];
  const StripStarts starts = strip_starts(plan, x_steps, y_steps);
  u32 seen[max_handle_polygons][max_handle_polygons][longest_tabled_polygon] = {};
  for (u32 s = 0, bit = 0; s < plan.strips; ++s) {
    const u32 x = plan.x[s], y = plan.y[s];
    u32 i = starts.at[x][s], j = starts.at[y][s] + y_steps[s];
    for (u32 t = 0;; ++t) {
      u32& row = seen[x][y][i % sides[x]];
      const u32 mark = 1u << (j % sides[y]);
      if (row & mark) return false;
      row |= mark;
      if (t == x_steps[s] + y_steps[s]) break;
      (word.steps >> bit++) & 1 ? ++i : --j;
    }
  }
  return true;
}

// The word of a strip as runs of x-steps with one y-step between any two: `first`, then for each of `vertices` a run of
// `each` steps, one more where `chosen` has a bit, then `last`.
constexpr u64 runs_word(u32 first, u32 last, u32 vertices, u32 each, u32 chosen) {
  u64 word = (u64{1} << first) - 1;
  u32 bit = first + 1;
  for (u32 v = 0; v < vertices; ++v) {
    const u32 run = each + ((chosen >> v) & 1);
    word |= ((u64{1} << run) - 1) << bit;
    bit += run + 1;
  }
  return word | ((u64{1} << last) - 1) << bit;
}

}  // namespace tpa
