// SPDX-License-Identifier: MIT
// small: handles of the few small keys that have neither alternating handles nor rings (paper section 4.2). Only for
// files whose constants the compiler evaluates.
//
// Their handles miss the alternating ones by little: a cost of one or two. So all strips alternate, with three
// exceptions. Both ends of a strip may lean to either side, even where a turn would make all three at a triangle agree.
// A strip may have a single step, or none. An extra step may follow another inside a strip, which leaves a vertex with
// two faces and costs one.
//
// The cost of the ends of the strips at the corners does not depend on the sides. Lengths are solved for afterwards, as
// for alternating handles.
#pragma once

#include "handles/rows.h"
#include "handles/unequal_row.h"

namespace tpa {

// The form of a strip, without its length. The first four forms alternate: bit 0 stands for an x-step at the start, bit
// 1 for an x-step at the end.
enum StripForm : u8 { alternating_forms = 4, no_steps = 4, one_x_step, one_y_step, strip_forms };

// Corner c of triangle t has number 3t + c and lies at the head of the triangle's slot c. `at[slot][0]` is
// the corner of strip slot / 2's polygon x, and `at[slot][1]` that of y.
struct CornerTable {
  u8 at[2 * max_plan_strips][2] = {};
};
constexpr CornerTable make_corners(const Plan& plan) {
  CornerTable corners;
  for (u32 slot = 0; slot < 2u * plan.strips; ++slot) {
    const u32 t = plan.triangle_of_slot[slot];
    for (u32 c = 0; c < 3; ++c) {
      const u32 head = slot_head(plan, plan.slots_of_triangle[t][c]);
      if (head == plan.x[slot / 2]) corners.at[slot][0] = static_cast<u8>(3 * t + c);
      if (head == plan.y[slot / 2]) corners.at[slot][1] = static_cast<u8>(3 * t + c);
    }
  }
  return corners;
}
struct AllCorners {
  CornerTable of_four[8];
};
constexpr AllCorners make_all_corners() {
  AllCorners all;
  for (u32 i = 0; i < 8; ++i) all.of_four[i] = make_corners(plans.of_four[i]);
  return all;
}
inline constexpr AllCorners all_corners = make_all_corners();

// The state of the corners after the forms chosen so far, four bits for each corner: its faces less three, and the
// corner that stands for it. Where a strip has no step of a polygon, the corners at its ends are one vertex. `left` are
// the sides of the polygons, less the steps of the strips so far at their shortest.
struct Corners {
  u64 e = 0, stands_for = 0xBA9876543210;
  i32 cost = 0, united = 0;
  i32 left[max_handle_polygons] = {};
};

struct SmallHandle {
  u8 plan = 0;
  u8 form[max_plan_strips] = {};
  i8 extra[max_plan_strips] = {};  // further steps of x, or of y where negative
  i32 length[max_plan_strips] = {};
};

struct SmallSearch {
  u32 k;
  const u32 (&sides)[max_handle_polygons];
  i32 target;
  WordBuilder& row;
};

constexpr u32 four_bits(u64 packed, u32 place) { return static_cast<u32>(packed >> (4 * place)) & 15; }

// One more face costs a vertex its present e.
constexpr void face_corner(Corners& corners, u32 corner) {
  corner = four_bits(corners.stands_for, corner);
  corners.cost += static_cast<i32>(four_bits(corners.e, corner));
  corners.e += u64{1} << (4 * corner);
}
constexpr void unite_corners(Corners& corners, u32 a, u32 b) {
  a = four_bits(corners.stands_for, a), b = four_bits(corners.stands_for, b);
  if (a == b) return;
  for (u32 c = 0; c < 3 * max_plan_triangles; ++c)
    if (four_bits(corners.stands_for, c) == b) corners.stands_for ^= u64{a ^ b} << (4 * c);
  const i32 e_a = static_cast<i32>(four_bits(corners.e, a)), e_b = static_cast<i32>(four_bits(corners.e, b));
  corners.cost += vertex_cost(e_a + e_b + 1) - vertex_cost(e_a) - vertex_cost(e_b);
  corners.e += u64(e_b + 1) << (4 * a);
  ++corners.united;
}

constexpr void add_strip(const Plan& plan, const CornerTable& table, u32 s, u32 form, Corners& corners) {
  const u8(&start)[2] = table.at[2 * s], (&end)[2] = table.at[2 * s + 1];
  if (form < alternating_forms) {
    face_corner(corners, start[form & 1]), face_corner(corners, end[form >> 1]);
    corners.left[plan.x[s]] -= form == 3 ? 2 : 1, corners.left[plan.y[s]] -= form == 0 ? 2 : 1;
    return;
  }
  if (form != one_x_step) unite_corners(corners, start[0], end[0]);
  if (form != one_y_step) unite_corners(corners, start[1], end[1]);
  if (form != no_steps) face_corner(corners, start[form == one_x_step ? 1 : 0]);
  if (form == one_x_step) --corners.left[plan.x[s]];
  if (form == one_y_step) --corners.left[plan.y[s]];
}

// Steps of x, and of y, that a strip has besides its length.
constexpr i32 steps_of_x(const SmallHandle& h, u32 s) {
  return (h.form[s] == 3 || h.form[s] == one_x_step ? 1 : 0) + max_of<i32>(0, h.extra[s]);
}
constexpr i32 steps_of_y(const SmallHandle& h, u32 s) {
  return (h.form[s] == 0 || h.form[s] == one_y_step ? 1 : 0) + max_of<i32>(0, -h.extra[s]);
}

// Writes the words: extra steps go to any vertices inside their strip.
constexpr void write_small(const SmallSearch& search, const SmallHandle& h, WordHandle word, u32 s, u32 bit) {
  const Plan& plan = plan_of(search.k, h.plan);
  if (s == plan.strips) {
    if (edges_differ(search.k, search.sides, word)) insert(search.row, word, unevenness(plan, word));
    return;
  }
  const u32 x_steps = static_cast<u32>(h.length[s] + steps_of_x(h, s));
  const u32 y_steps = static_cast<u32>(h.length[s] + steps_of_y(h, s)), steps = x_steps + y_steps;
  word.x_steps[s] = static_cast<u8>(x_steps), word.y_steps[s] = static_cast<u8>(y_steps);
  if (h.form[s] >= alternating_forms) {
    word.steps |= u64{x_steps} << bit;
    return write_small(search, h, word, s + 1, bit + steps);
  }
  // Runs of the kind with extra steps, between steps of the other kind.
  const bool of_y = h.extra[s] < 0;
  const u32 more = static_cast<u32>(of_y ? -h.extra[s] : h.extra[s]), vertices = (of_y ? x_steps : y_steps) - 1;
  const u32 first = (h.form[s] & 1) ^ u32 { of_y }, last = (h.form[s] >> 1) ^ u32 { of_y };
  for (u32 chosen = (1u << more) - 1; chosen < 1u << vertices; chosen = next_choice(chosen)) {
    WordHandle next = word;
    const u64 runs = runs_word(first, last, vertices, 1, chosen);
    next.steps |= (of_y ? runs ^ ((u64{1} << steps) - 1) : runs) << bit;
    write_small(search, h, next, s + 1, bit + steps);
  }
}

// Values of a free length that strip s allows: its length must be zero if the strip does not alternate, otherwise
// positive.
struct Interval {
  i32 low = 0, high = INT32_MAX;
};
constexpr void restrict_to(Interval& free, i32 length, i32 by, bool alternates) {
  // length + by * free >= 1 (or == 0)
  const i32 least = alternates ? 1 : 0;
  if (by > 0) free.low = max_of(free.low, least - length);
  if (by < 0) free.high = min_of(free.high, length - least);
  if (by > 0 && !alternates) free.high = min_of(free.high, -length);
  if (by < 0 && !alternates) free.low = max_of(free.low, length);
  if (by == 0 && (alternates ? length < 1 : length != 0)) free.high = -1;
}

constexpr void solve_small(const SmallSearch& search, SmallHandle& h) {
  const Plan& plan = plan_of(search.k, h.plan);
  LengthRule rule;
  for (u32 p = 0; p < search.k; ++p) rule.sum[p] = static_cast<i32>(search.sides[p]);
  for (u32 s = 0; s < plan.strips; ++s)
    rule.sum[plan.x[s]] -= steps_of_x(h, s), rule.sum[plan.y[s]] -= steps_of_y(h, s);
  i32 base[max_plan_strips] = {}, by0[max_plan_strips] = {}, by1[max_plan_strips] = {};
  linear_lengths(search.k, plan, rule, base, by0, by1);
  Interval free0;
  for (u32 s = 0; s < plan.strips; ++s)
    if (by1[s] == 0) restrict_to(free0, base[s], by0[s], h.form[s] < alternating_forms);
  free0.high = min_of(free0.high, static_cast<i32>(search.sides[0]));
  for (i32 at0 = free0.low; at0 <= free0.high; ++at0) {
    Interval free1;
    for (u32 s = 0; s < plan.strips; ++s)
      restrict_to(free1, base[s] + by0[s] * at0, by1[s], h.form[s] < alternating_forms);
    for (i32 at1 = free1.low; at1 <= free1.high; ++at1) {
      for (u32 s = 0; s < plan.strips; ++s) h.length[s] = base[s] + by0[s] * at0 + by1[s] * at1;
      WordHandle word;
      word.plan = h.plan;
      write_small(search, h, word, 0, 0);
    }
  }
}

// Gives `extras` further steps to alternating strips from s on. Pre: the remaining sides of the polygons and the extras
// are even together, since each length takes one of two polygons each.
constexpr void add_extras(const SmallSearch& search, SmallHandle& h, u32 s, i32 extras,
                          const i32 (&left)[max_handle_polygons]) {
  if (extras == 0) return solve_small(search, h);
  const Plan& plan = plan_of(search.k, h.plan);
  if (s == plan.strips) return;
  const bool alternates = h.form[s] < alternating_forms;
  const i32 x_most = alternates ? min_of(extras, left[plan.x[s]]) : 0;
  const i32 y_most = alternates ? min_of(extras, left[plan.y[s]]) : 0;
  for (i32 extra = -y_most; extra <= x_most; ++extra) {
    h.extra[s] = static_cast<i8>(extra);
    add_extras(search, h, s + 1, extras - abs_of_integer(extra), left);
  }
  h.extra[s] = 0;
}

// Chooses the forms of the strips from s on. The sum of e over all vertices equals the sum over the corners, and there
// are as many corners as this sum. So each corner united with another leaves a surplus, which costs at least one.
constexpr void choose_forms(const SmallSearch& search, SmallHandle& h, u32 s, const Corners& corners) {
  const Plan& plan = plan_of(search.k, h.plan);
  if (s == plan.strips) {
    const i32 extras = search.target - corners.cost, *left = corners.left;
    if (((left[0] + left[1] + left[2] + left[3] + extras) & 1) == 0) add_extras(search, h, 0, extras, corners.left);
    return;
  }
  const CornerTable& table = all_corners.of_four[h.plan];
  for (u32 form = 0; form < strip_forms; ++form) {
    Corners next = corners;
    add_strip(plan, table, s, form, next);
    if (next.cost > search.target || next.united > search.target) continue;
    if (next.left[plan.x[s]] < 0 || next.left[plan.y[s]] < 0) continue;
    h.form[s] = static_cast<u8>(form);
    choose_forms(search, h, s + 1, next);
  }
}

constexpr void gather_small(u32 k, const u32 (&sides)[max_handle_polygons], WordBuilder& row) {
  for (i32 target = 1; row.count == 0; ++target)
    for (u32 plan = 0; plan < plan_count(k); ++plan) {
      if (!plan_has_generators(k, plan, row.exchanges)) continue;
      SmallHandle h;
      h.plan = static_cast<u8>(plan);
      Corners corners;
      for (u32 p = 0; p < k; ++p) corners.left[p] = static_cast<i32>(sides[p]);
      choose_forms({k, sides, target, row}, h, 0, corners);
    }
}

}  // namespace tpa
