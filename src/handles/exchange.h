// SPDX-License-Identifier: MIT
// exchange: the effect of an exchange of polygons on a handle (paper section 4.2, group action 2). Exchanging polygons
// renames the vertices of the plan. The renamed plan is again one of the plans, with strips and inner triangles
// renamed, and perhaps strips read from their other end.
#pragma once

#include "handles/words.h"

namespace tpa {

inline constexpr u32 permutation_count(u32 k) { return k == 2 ? 2 : k == 3 ? 6 : 24; }

struct Permutation {
  u8 to[max_handle_polygons] = {0, 1, 2, 3};
};

// The permutations of k polygons in lexicographic order, the identity first.
constexpr Permutation permutation(u32 k, u32 index) {
  Permutation p;
  u32 radix = permutation_count(k);
  for (u32 at = 0; at + 1 < k; ++at) {
    radix /= k - at;
    const u32 pick = at + index / radix;
    index %= radix;
    const u8 chosen = p.to[pick];
    for (u32 m = pick; m > at; --m) p.to[m] = p.to[m - 1];
    p.to[at] = chosen;
  }
  return p;
}

// Polygon p becomes polygon to[p] of plan `plan`; the first slot of strip s becomes slot[s].
struct Exchange {
  u8 plan = 0;
  u8 slot[max_plan_strips] = {};
  u8 triangle[max_plan_triangles] = {};

  constexpr u32 strip(u32 s) const { return slot[s] / 2; }
  // Is the strip read backwards?
  constexpr bool flipped(u32 s) const { return slot[s] % 2 != 0; }
};

// Do the strips of `from`, renamed, follow each other around every polygon of `to` in its order?
constexpr bool agrees_around(const Plan& from, const Plan& to, const Permutation& p, const Exchange& exchange) {
  for (u32 polygon = 0; polygon < from.polygons; ++polygon) {
    const u32 image = p.to[polygon], degree = from.degree[polygon];
    if (to.degree[image] != degree) return false;
    u32 shift = 0;
    while (shift < degree && to.around[image][shift] != exchange.strip(from.around[polygon][0])) ++shift;
    for (u32 t = 0; t < degree; ++t)
      if (to.around[image][(t + shift) % degree] != exchange.strip(from.around[polygon][t])) return false;
  }
  return true;
}

// Renames strips by their polygons. `swap_twins` tells the two strips between a and b of a row plan apart.
constexpr bool rename_strips(const Plan& from, const Plan& to, const Permutation& p, bool swap_twins, Exchange& out) {
  for (u32 s = 0; s < from.strips; ++s) {
    const u32 x = p.to[from.x[s]], y = p.to[from.y[s]];
    u32 matches = 0;
    for (u32 z = 0; z < to.strips; ++z) {
      const bool same = to.x[z] == x && to.y[z] == y, flipped = to.x[z] == y && to.y[z] == x;
      if (!same && !flipped) continue;
      // Strips 1 and 3 are the twins; strip 3 takes the second match, or strip 1 when swapped.
      const bool wants_second = (s == 3) != swap_twins;
      if (matches++ == 0 || wants_second) out.slot[s] = static_cast<u8>(2 * z + (flipped ? 1 : 0));
    }
    if (matches == 0) return false;
  }
  return agrees_around(from, to, p, out);
}

constexpr Exchange make_exchange(u32 k, u32 plan, const Permutation& p) {
  Exchange exchange;
  const Plan& from = plan_of(k, plan);
  if (k == 2) {  // the closed strip is its own image
    exchange.slot[0] = p.to[0] == 1 ? 1 : 0;
    return exchange;
  }
  for (u32 candidate = 0; candidate < plan_count(k); ++candidate) {
    const Plan& to = plan_of(k, candidate);
    if (!rename_strips(from, to, p, false, exchange) && !rename_strips(from, to, p, true, exchange)) continue;
    exchange.plan = static_cast<u8>(candidate);
    for (u32 slot = 0; slot < 2u * from.strips; ++slot) {
      const u32 image = exchange.slot[slot / 2] ^ (slot & 1u);
      exchange.triangle[from.triangle_of_slot[slot]] = to.triangle_of_slot[image];
    }
    return exchange;
  }
  return exchange;
}

struct ExchangeTable {
  Permutation of_two[2], of_three[6], of_four[24];
  Exchange two[2], three[6], four[8][24];
};
constexpr ExchangeTable make_exchanges() {
  ExchangeTable table;
  for (u32 i = 0; i < 2; ++i) table.two[i] = make_exchange(2, 0, table.of_two[i] = permutation(2, i));
  for (u32 i = 0; i < 6; ++i) table.three[i] = make_exchange(3, 0, table.of_three[i] = permutation(3, i));
  for (u32 i = 0; i < 24; ++i) {
    table.of_four[i] = permutation(4, i);
    for (u32 plan = 0; plan < 8; ++plan) table.four[plan][i] = make_exchange(4, plan, table.of_four[i]);
  }
  return table;
}
inline constexpr ExchangeTable exchanges = make_exchanges();

constexpr const Permutation& permutation_of(u32 k, u32 index) {
  return k == 2 ? exchanges.of_two[index] : k == 3 ? exchanges.of_three[index] : exchanges.of_four[index];
}
constexpr const Exchange& exchange_of(u32 k, u32 plan, u32 index) {
  return k == 2 ? exchanges.two[index] : k == 3 ? exchanges.three[index] : exchanges.four[plan][index];
}

// Only polygons with equal numbers of vertices may change places.
constexpr bool permits(u32 k, const u32 (&sides)[max_handle_polygons], u32 index) {
  const Permutation& p = permutation_of(k, index);
  for (u32 i = 0; i < k; ++i)
    if (sides[i] != sides[p.to[i]]) return false;
  return true;
}

// The handle with its words renamed, and strips read backwards where the exchange turns them.
constexpr WordHandle exchanged(u32 k, const WordHandle& handle, u32 index) {
  const Exchange& exchange = exchange_of(k, handle.plan, index);
  const u32 strips = plan_of(k, handle.plan).strips;
  WordHandle image;
  u64 word[max_plan_strips] = {};
  u32 bit = 0;
  for (u32 s = 0; s < strips; ++s) {
    const u32 z = exchange.strip(s), length = handle.x_steps[s] + handle.y_steps[s];
    const bool flipped = exchange.flipped(s);
    image.x_steps[z] = flipped ? handle.y_steps[s] : handle.x_steps[s];
    image.y_steps[z] = flipped ? handle.x_steps[s] : handle.y_steps[s];
    for (u32 t = 0; t < length; ++t, ++bit) {
      const u64 x = (handle.steps >> bit) & 1;
      word[z] |= flipped ? (x ^ 1) << (length - 1 - t) : x << t;
    }
  }
  bit = 0;
  image.plan = exchange.plan;
  for (u32 z = 0; z < strips; ++z) {
    image.steps |= word[z] << bit;
    bit += image.x_steps[z] + image.y_steps[z];
  }
  return image;
}

// Orders handles of one key: plan, steps of the strips, words.
constexpr i32 compare(const WordHandle& a, const WordHandle& b) {
  if (a.plan != b.plan) return a.plan < b.plan ? -1 : 1;
  for (u32 s = 0; s < max_plan_strips; ++s) {
    if (a.x_steps[s] != b.x_steps[s]) return a.x_steps[s] < b.x_steps[s] ? -1 : 1;
    if (a.y_steps[s] != b.y_steps[s]) return a.y_steps[s] < b.y_steps[s] ? -1 : 1;
  }
  return a.steps == b.steps ? 0 : a.steps < b.steps ? -1 : 1;
}

}  // namespace tpa
