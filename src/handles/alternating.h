// SPDX-License-Identifier: MIT
// alternating: handles whose vertices all have three or four faces, by arithmetic (paper section 4.2).
//
// A handle has 3(mu + 2k - 4) corners on mu vertices: on average a little more than three for each vertex. If all
// vertices have three or four, the sum of squares is as small as it can be. This forces the shape. Every strip
// alternates. At each of the 2k - 4 inner triangles the last faces of the three strips lean the same way round, so that
// each corner gets one of them; the turn of the triangle is this way. Only the lengths of the strips are left. The
// sides of the polygons leave no length free for k = 3, and two lengths for k = 4.
#pragma once

#include "handles/exchange.h"

namespace tpa {

constexpr bool is_tetrahedral(const Plan& plan) { return plan.degree[0] == 3; }
constexpr i32 abs_of_integer(i32 a) { return a < 0 ? -a : a; }

// `length[s]` counts the pairs of steps (x, y) of strip s; the turns of the triangles at its ends add at most one step.
struct Alternating {
  u8 plan = 0;
  u8 turns = 0;
  i32 length[max_plan_strips] = {};
};

constexpr bool turned(u8 turns, const Plan& plan, u32 slot) { return (turns >> plan.triangle_of_slot[slot]) & 1; }

constexpr EvenHandle to_even(u32 k, const Alternating& handle) {
  const Plan& plan = plan_of(k, handle.plan);
  EvenHandle even;
  even.plan = handle.plan;
  for (u32 s = 0; s < plan.strips; ++s) {
    const bool x_first = turned(handle.turns, plan, 2 * s), x_last = !turned(handle.turns, plan, 2 * s + 1);
    const u32 length = static_cast<u32>(handle.length[s]);
    even.strip[s].x_steps = length + (x_first && x_last ? 1 : 0);
    even.strip[s].y_steps = length + (!x_first && !x_last ? 1 : 0);
    even.strip[s].x_first = x_first, even.strip[s].x_last = x_last;
  }
  return even;
}

// Conditions on the lengths: the lengths around polygon p sum up to `sum[p]`.
struct LengthRule {
  i32 sum[max_handle_polygons] = {};
};
// Contribution of the turns to the sums: a strip with x-steps at both ends takes 1 from x, and a strip with y-steps at
// both ends 1 from y.
struct TurnRule {
  i8 sum[max_handle_polygons] = {};
};
constexpr TurnRule make_turn_rule(const Plan& plan, u8 turns) {
  TurnRule rule;
  for (u32 s = 0; s < plan.strips; ++s) {
    const bool x_first = turned(turns, plan, 2 * s), x_last = !turned(turns, plan, 2 * s + 1);
    if (x_first && x_last) --rule.sum[plan.x[s]];
    if (!x_first && !x_last) --rule.sum[plan.y[s]];
  }
  return rule;
}
struct TurnRules {
  TurnRule of_three[4], of_four[8][16];
};
constexpr TurnRules make_turn_rules() {
  TurnRules rules;
  for (u32 turns = 0; turns < 4; ++turns) rules.of_three[turns] = make_turn_rule(plans.of_three, u8(turns));
  for (u32 plan = 0; plan < 8; ++plan)
    for (u32 turns = 0; turns < 16; ++turns)
      rules.of_four[plan][turns] = make_turn_rule(plans.of_four[plan], u8(turns));
  return rules;
}
inline constexpr TurnRules turn_rules = make_turn_rules();

constexpr LengthRule length_rule(u32 k, u32 plan, u8 turns, const u32 (&sides)[max_handle_polygons]) {
  const TurnRule& taken = k == 3 ? turn_rules.of_three[turns] : turn_rules.of_four[plan][turns];
  LengthRule rule;
  for (u32 p = 0; p < k; ++p) rule.sum[p] = static_cast<i32>(sides[p]) + taken.sum[p];
  return rule;
}

// All lengths as linear functions of the lengths of strips 0 and 1, which are free (for k = 3 none is). Pre: the sums
// add up to an even number.
constexpr void linear_lengths(u32 k, const Plan& plan, const LengthRule& rule, i32 (&base)[max_plan_strips],
                              i32 (&by0)[max_plan_strips], i32 (&by1)[max_plan_strips]) {
  const i32 *c = rule.sum, half = (c[0] + c[1] + c[2] + c[3]) / 2;
  if (k == 3) {
    base[0] = half - c[2], base[1] = half - c[0], base[2] = half - c[1];
    return;
  }
  by0[0] = by1[1] = 1;
  if (is_tetrahedral(plan)) {
    base[2] = c[0], by0[2] = by1[2] = -1;
    base[3] = half - c[3], by0[3] = by1[3] = -1;
    base[4] = half - c[0] - c[2], by1[4] = 1;
    base[5] = half - c[0] - c[1], by0[5] = 1;
  } else {
    const i32 a = c[plan.x[0]], narrow0 = c[plan.y[0]], narrow1 = c[plan.y[2]], twins = half - narrow0 - narrow1;
    base[2] = a - twins, by0[2] = -1;
    base[3] = twins, by1[3] = -1;
    base[4] = narrow0, by0[4] = -1;
    base[5] = narrow1 - a + twins, by0[5] = 1;
  }
}

// Solves for all lengths; false where some length would not be positive.
constexpr bool solve_lengths(u32 k, const Plan& plan, const LengthRule& rule, i32 free0, i32 free1,
                             i32 (&length)[max_plan_strips]) {
  if ((rule.sum[0] + rule.sum[1] + rule.sum[2] + rule.sum[3]) & 1) return false;
  i32 base[max_plan_strips] = {}, by0[max_plan_strips] = {}, by1[max_plan_strips] = {};
  linear_lengths(k, plan, rule, base, by0, by1);
  bool positive = true;
  for (u32 s = 0; s < plan.strips; ++s) {
    length[s] = base[s] + by0[s] * free0 + by1[s] * free1;
    positive = positive && length[s] >= 1;
  }
  return positive;
}

constexpr bool is_crowded(const Plan& plan) { return plan.polygons == 4 && !is_tetrahedral(plan); }
inline constexpr u64 crowding = u64{1} << 48;

// Unevenness of the strips: the sum of the squares of their numbers of faces. Tetrahedral plans come before rows, whose
// inner corners crowd on two polygons.
constexpr u64 unevenness(const Plan& plan, const EvenHandle& handle) {
  u64 sum = is_crowded(plan) ? crowding : 0;
  for (u32 s = 0; s < plan.strips; ++s) {
    const u64 n = u64{handle.strip[s].x_steps} + handle.strip[s].y_steps;
    sum += n * n;
  }
  return sum;
}

// Ranges of the free lengths.
struct FreeLengths {
  i32 low0 = 0, high0 = 0, low1 = 0, high1 = 0;
};

// All free lengths that can have a solution.
constexpr FreeLengths all_free_lengths(u32 k, const Plan& plan, const LengthRule& rule) {
  if (k != 4) return {};
  const i32 *c = rule.sum, half = (c[0] + c[1] + c[2] + c[3]) / 2;
  if (is_tetrahedral(plan))
    return {max_of<i32>(1, 1 + c[0] + c[1] - half), min_of(c[0], c[1]) - 2, max_of<i32>(1, 1 + c[0] + c[2] - half),
            min_of(c[0], c[2]) - 2};
  const i32 a = c[plan.x[0]], narrow0 = c[plan.y[0]], narrow1 = c[plan.y[2]];
  const i32 twins = half - narrow0 - narrow1, sum = a - twins;
  return {max_of<i32>(1, sum - narrow1 + 1), min_of(sum, narrow0) - 1, 1, twins - 1};
}

// Free lengths near the most even solution. Opposite strips of the tetrahedron differ by a constant, and all pairs have
// the sum `half`, so each pair gets a third, or as much as its constant demands. In a row, strips get halves.
constexpr FreeLengths even_free_lengths(u32 k, const Plan& plan, const LengthRule& rule) {
  constexpr i32 reach = 4;
  if (k != 4) return {};
  const FreeLengths all = all_free_lengths(k, plan, rule);
  const i32 *c = rule.sum, half = (c[0] + c[1] + c[2] + c[3]) / 2;
  i32 at0 = 0, at1 = (all.low1 + all.high1) / 2;
  if (is_tetrahedral(plan)) {
    const i32 d[3] = {c[0] + c[1] - half, c[0] + c[2] - half, c[0] + c[3] - half};
    i32 pair[3] = {}, rest = half, left = 3;
    bool fixed[3] = {};
    for (u32 i = 0; i < 9; ++i) {  // demands above the share first; three rounds settle all
      const i32 demand = abs_of_integer(d[i % 3]) + 2;
      if (fixed[i % 3] || left == 0 || demand * left <= rest) continue;
      pair[i % 3] = demand, rest -= demand, fixed[i % 3] = true, --left;
    }
    for (u32 i = 0; i < 3; ++i)
      if (!fixed[i]) pair[i] = rest / left;
    at0 = (pair[0] + d[0]) / 2, at1 = (pair[1] + d[1]) / 2;
  } else {
    const i32 narrow0 = c[plan.y[0]], narrow1 = c[plan.y[2]], sum = c[plan.x[0]] - half + narrow0 + narrow1;
    at0 = min_of(max_of((2 * sum + narrow0 - narrow1) / 4, all.low0), all.high0);
  }
  return {max_of(all.low0, at0 - reach), min_of(all.high0, at0 + reach), max_of(all.low1, at1 - reach),
          min_of(all.high1, at1 + reach)};
}

// Vertices of the other polygon that strip s has to itself: each can take one more step of p without a cost to p.
constexpr u32 free_vertices(const Plan& plan, const EvenStrip& strip, u32 s, u32 p) {
  const u32 facing = plan.x[s] == p ? strip.y_steps : plan.y[s] == p ? strip.x_steps : 0;
  return facing > 0 ? facing - 1 : 0;
}

// Puts `surplus` more steps of polygon p into its strips, in proportion to the vertices with room for more steps.
constexpr void add_surplus(u32 k, u32 p, u32 surplus, EvenHandle& handle) {
  const Plan& plan = plan_of(k, handle.plan);
  u64 all = 0, before = 0;
  for (u32 s = 0; s < plan.strips; ++s) all += free_vertices(plan, handle.strip[s], s, p);
  const u32 extra = all == 0 ? 1 : 0;  // without such vertices, all strips get the same
  if (extra != 0) all = plan.degree[p];
  for (u32 s = 0; s < plan.strips; ++s) {
    if (plan.x[s] != p && plan.y[s] != p) continue;
    const u64 after = before + free_vertices(plan, handle.strip[s], s, p) + extra;
    const u32 share = static_cast<u32>(after * surplus / all - before * surplus / all);
    (plan.x[s] == p ? handle.strip[s].x_steps : handle.strip[s].y_steps) += share;
    before = after;
  }
}

// The most even alternating handle for these sides, tetrahedral plans first; false without any.
constexpr bool most_even_alternating(u32 k, const u32 (&sides)[max_handle_polygons], EvenHandle& best) {
  u64 best_value = UINT64_MAX;
  for (u32 index = 0; index < plan_count(k); ++index) {
    if (index == tetrahedral_plans && best_value != UINT64_MAX) return true;
    const Plan& plan = plan_of(k, index);
    for (u32 turns = 0; turns < 1u << plan.triangles; ++turns) {
      Alternating handle{static_cast<u8>(index), static_cast<u8>(turns), {}};
      const LengthRule rule = length_rule(k, handle.plan, handle.turns, sides);
      const FreeLengths range = even_free_lengths(k, plan, rule);
      for (i32 free0 = range.low0; free0 <= range.high0; ++free0)
        for (i32 free1 = range.low1; free1 <= range.high1; ++free1) {
          if (!solve_lengths(k, plan, rule, free0, free1, handle.length)) continue;
          const EvenHandle even = to_even(k, handle);
          const u64 value = unevenness(plan, even);
          if (value < best_value) best_value = value, best = even;
        }
    }
  }
  return best_value != UINT64_MAX;
}

// A well balanced handle for any polygons of 3 to 65535 sides. If no alternating handle exists, the longest polygon is
// shortened until an alternating handle exists, and the surplus is spread. Pre: sides sorted, longest first.
constexpr EvenHandle balanced_handle(u32 k, const u32 (&sides)[max_handle_polygons]) {
  EvenHandle handle;
  if (k == 2) {
    handle.strip[0].x_steps = sides[0], handle.strip[0].y_steps = sides[1], handle.strip[0].closed = true;
    return handle;
  }
  u32 shortened[max_handle_polygons] = {sides[0], sides[1], sides[2], sides[3]};
  const u32 others = sides[1] + sides[2] + sides[3];
  shortened[0] = min_of(sides[0], others - 2 * (k - 2));
  while (!most_even_alternating(k, shortened, handle)) --shortened[0];
  if (sides[0] > shortened[0]) add_surplus(k, 0, sides[0] - shortened[0], handle);
  return handle;
}

}  // namespace tpa
