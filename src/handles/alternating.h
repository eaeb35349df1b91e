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

constexpr WordHandle to_words(u32 k, const Alternating& handle) {
  const Plan& plan = plan_of(k, handle.plan);
  WordHandle words;
  words.plan = handle.plan;
  u32 bit = 0;
  for (u32 s = 0; s < plan.strips; ++s) {
    const bool x_first = turned(handle.turns, plan, 2 * s), x_last = !turned(handle.turns, plan, 2 * s + 1);
    words.x_steps[s] = static_cast<u8>(handle.length[s] + (x_first && x_last ? 1 : 0));
    words.y_steps[s] = static_cast<u8>(handle.length[s] + (!x_first && !x_last ? 1 : 0));
    const u32 steps = u32{words.x_steps[s]} + words.y_steps[s];
    for (u32 t = x_first ? 0 : 1; t < steps; t += 2) words.steps |= u64{1} << (bit + t);
    bit += steps;
  }
  return words;
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

}  // namespace tpa
