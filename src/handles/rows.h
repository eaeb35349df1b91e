// SPDX-License-Identifier: MIT
// rows: makes the rows of the database (paper section 4.2). Only for files whose constants the compiler evaluates.
//
// The rule: among the handles of a key without edges inside a polygon, those with the smallest sum of squared numbers
// of faces over the vertices; among handles that rotations and exchanges turn into each other, one. Rows hold up to 32
// generators, in order of unevenness.
#pragma once

#include "handles/handle_table.h"

namespace tpa {

// The numbers 0 .. n-1 as a type, without the C++ library. By halves, since compilers limit the depth of templates.
template <u32... indices>
struct Indices {};
template <class Low, class High>
struct JoinedIndices;
template <u32... low, u32... high>
struct JoinedIndices<Indices<low...>, Indices<high...>> {
  using Type = Indices<low..., (u32{sizeof...(low)} + high)...>;
};
template <u32 n>
struct FirstIndices : JoinedIndices<typename FirstIndices<n / 2>::Type, typename FirstIndices<n - n / 2>::Type> {};
template <>
struct FirstIndices<0> {
  using Type = Indices<>;
};
template <>
struct FirstIndices<1> {
  using Type = Indices<0>;
};
template <u32 n>
using IndicesUpTo = typename FirstIndices<n>::Type;

// The next larger number with as many bits; after 0 the largest of all, since there is none.
constexpr u32 next_choice(u32 chosen) {
  if (chosen == 0) return UINT32_MAX;
  const u32 low = chosen & (~chosen + 1), next = chosen + low;
  return next | (((chosen ^ next) / low) >> 2);
}

constexpr HandleRow row_of_two(u32 index) {
  const RowSides key = sides_of_row(2, index);
  const u32 beads = key.sides[1], longer = key.sides[0] % beads;
  HandleRow row;
  row.complete = true;
  for (u32 code = (1u << longer) - 1; code >> beads == 0; code = next_choice(code)) {
    bool smallest = true;
    for (u32 by = 1; by < beads && smallest; ++by) smallest = rotated_necklace(code, beads, by) >= code;
    if (smallest) row.code[row.count++] = static_cast<u16>(code);
  }
  return row;
}

// The exchanges of equal polygons, by their index among the permutations, without the identity.
struct ExchangeList {
  u8 index[24] = {};
  u32 count = 0;
};
constexpr ExchangeList permitted_exchanges(u32 k, const u32 (&sides)[max_handle_polygons]) {
  ExchangeList list;
  for (u32 i = 1; i < permutation_count(k); ++i)
    if (permits(k, sides, i)) list.index[list.count++] = static_cast<u8>(i);
  return list;
}

// The generator has the smallest code of all handles that exchanges turn into each other.
constexpr bool is_generator(u32 k, const Alternating& handle, const ExchangeList& list) {
  const u16 code = code_of(k, handle);
  for (u32 i = 0; i < list.count; ++i)
    if (code_of(k, exchanged(k, handle, list.index[i])) < code) return false;
  return true;
}

// A row under construction: generators in order of unevenness, then code. The last generators fall off the end of a
// full row.
struct RowBuilder {
  u16 code[row_capacity] = {};
  u64 value[row_capacity] = {};
  u32 count = 0;
  bool dropped = false;
};
constexpr bool has_room(const RowBuilder& row, u64 value, u16 code) {
  if (row.count < row_capacity) return true;
  const u32 last = row_capacity - 1;
  return value < row.value[last] || (value == row.value[last] && code < row.code[last]);
}
constexpr void insert(RowBuilder& row, u64 value, u16 code) {
  u32 at = row.count;
  if (at == row_capacity) {
    row.dropped = true;
    if (!has_room(row, value, code)) return;
    --at;
  } else {
    ++row.count;
  }
  for (; at > 0 && (row.value[at - 1] > value || (row.value[at - 1] == value && row.code[at - 1] > code)); --at)
    row.code[at] = row.code[at - 1], row.value[at] = row.value[at - 1];
  row.code[at] = code, row.value[at] = value;
}

// The handles of one plan and turns as a lattice: strip s has 2 (base + by0 free0 + by1 free1) + odd faces.
struct LengthLattice {
  i32 base[max_plan_strips] = {}, by0[max_plan_strips] = {}, by1[max_plan_strips] = {}, odd[max_plan_strips] = {};
  FreeLengths range;
};

// The points of one lattice with a given free0: a line, from `low` to `high` with positive lengths only.
struct LengthLine {
  i32 length[max_plan_strips] = {};  // at free1 = 0
  i32 low = 0, high = 0, middle = 0;
};
constexpr LengthLine line_of(u32 strips, const LengthLattice& lattice, i32 free0) {
  LengthLine line;
  line.low = lattice.range.low1, line.high = lattice.range.high1;
  i32 slope = 0, curvature = 0;
  for (u32 s = 0; s < strips; ++s) {
    const i32 length = lattice.base[s] + lattice.by0[s] * free0, by1 = lattice.by1[s];
    line.length[s] = length;
    if (by1 > 0)
      line.low = max_of(line.low, 1 - length);
    else if (by1 < 0)
      line.high = min_of(line.high, length - 1);
    else if (length < 1)
      line.high = line.low - 1;
    if (by1 == 0) continue;
    slope -= by1 * (2 * length + lattice.odd[s]);
    curvature += 2;
  }
  // Unevenness along the line is a parabola with its integer vertex here.
  if (curvature != 0) line.middle = (slope >= 0 ? slope + curvature / 2 : slope - curvature / 2) / curvature;
  line.middle = max_of(min_of(line.middle, line.high), line.low);
  return line;
}

// Tries one point; false where it is too uneven for the row.
constexpr bool try_point(u32 k, Alternating& handle, const LengthLattice& lattice, const LengthLine& line, i32 free1,
                         const ExchangeList& list, RowBuilder& row) {
  const u32 strips = k == 4 ? 6 : 3;
  i32 squares = 0;
  for (u32 s = 0; s < strips; ++s) {
    const i32 length = line.length[s] + lattice.by1[s] * free1, faces = 2 * length + lattice.odd[s];
    handle.length[s] = length;
    squares += faces * faces;
  }
  const u64 value = (k == 4 && handle.plan >= tetrahedral_plans ? crowding : 0) + static_cast<u32>(squares);
  if (row.dropped && value > row.value[row_capacity - 1]) return false;
  if (is_generator(k, handle, list)) insert(row, value, code_of(k, handle));
  return true;
}

// Tries free1 outwards from its best value; unevenness grows on either side. Returns whether any point passed.
constexpr bool try_line(u32 k, Alternating& handle, const LengthLattice& lattice, i32 free0, const ExchangeList& list,
                        RowBuilder& row) {
  const LengthLine line = line_of(k == 4 ? 6 : 3, lattice, free0);
  if (line.low > line.high || !try_point(k, handle, lattice, line, line.middle, list, row)) return false;
  for (i32 free1 = line.middle + 1; free1 <= line.high; ++free1)
    if (!try_point(k, handle, lattice, line, free1, list, row)) break;
  for (i32 free1 = line.middle - 1; free1 >= line.low; --free1)
    if (!try_point(k, handle, lattice, line, free1, list, row)) break;
  return true;
}

// Most of the compiler's time goes here. Once the row is full, the search along free0 stops after two lines without an
// entry. The sum of squares is convex, so nothing is missed; a test compares with all points.
constexpr void gather_turns(u32 k, Alternating handle, const LengthRule& rule, const ExchangeList& list,
                            RowBuilder& row) {
  const Plan& plan = plan_of(k, handle.plan);
  LengthLattice lattice;
  lattice.range = all_free_lengths(k, plan, rule);
  linear_lengths(k, plan, rule, lattice.base, lattice.by0, lattice.by1);
  for (u32 s = 0; s < plan.strips; ++s)
    lattice.odd[s] = turned(handle.turns, plan, 2 * s) != turned(handle.turns, plan, 2 * s + 1) ? 1 : 0;
  const i32 middle = (lattice.range.low0 + lattice.range.high0) / 2;
  for (i32 direction = 1; direction >= -1; direction -= 2) {
    u32 idle = 0;
    for (i32 free0 = direction > 0 ? middle : middle - 1;
         free0 >= lattice.range.low0 && free0 <= lattice.range.high0 && idle < 2; free0 += direction)
      idle = try_line(k, handle, lattice, free0, list, row) || !row.dropped ? 0 : idle + 1;
  }
}

constexpr void gather_alternating(u32 k, u32 plan_index, const u32 (&sides)[max_handle_polygons],
                                  const ExchangeList& list, RowBuilder& row) {
  const Plan& plan = plan_of(k, plan_index);
  for (u32 turns = 0; turns < 1u << plan.triangles; ++turns) {
    const Alternating handle{static_cast<u8>(plan_index), static_cast<u8>(turns), {}};
    const LengthRule rule = length_rule(k, plan_index, handle.turns, sides);
    if (((rule.sum[0] + rule.sum[1] + rule.sum[2] + rule.sum[3]) & 1) == 0) gather_turns(k, handle, rule, list, row);
  }
}

// The alternating handles of a key; none if its polygons are too unequal.
constexpr HandleRow row_of_more(u32 k, u32 index) {
  const RowSides key = sides_of_row(k, index);
  const ExchangeList list = permitted_exchanges(k, key.sides);
  RowBuilder row;
  for (u32 plan = 0; plan < plan_count(k); ++plan) {
    if (plan == tetrahedral_plans && row.dropped) break;  // no row plan would get in
    gather_alternating(k, plan, key.sides, list, row);
  }
  HandleRow out;
  for (u32 i = 0; i < row.count; ++i) out.code[i] = row.code[i];
  out.count = static_cast<u8>(row.count);
  out.complete = row.count > 0 && !row.dropped;
  return out;
}

// Every row is a constant of its own, so that no evaluation runs into a limit of the compiler.
template <u32 k, u32 index>
inline constexpr HandleRow row = k == 2 ? row_of_two(index) : row_of_more(k, index);

template <u32 k, u32 first, u32... indices>
constexpr HandleRows<sizeof...(indices)> make_rows(Indices<indices...>) {
  return {{row<k, first + indices>...}};
}
template <u32 k, u32 first, u32 count>
constexpr HandleRows<count> rows_from() {
  return make_rows<k, first>(IndicesUpTo<count>{});
}

// The tests prove the rows with these bits; every compiler must make the same rows.
constexpr u64 mix(u64 hash, u64 value) { return (hash ^ value) * 0x100000001b3; }  // FNV-1a
inline constexpr u64 mix_basis = 0xcbf29ce484222325;

template <class Row, u32 count>
constexpr u32 generators_in(const Row (&rows)[count]) {
  u32 sum = 0;
  for (const Row& r : rows) sum += r.count;
  return sum;
}
template <u32 count>
constexpr u64 fingerprint(const HandleRows<count>& rows) {
  u64 hash = mix_basis;
  for (const HandleRow& r : rows.at) {
    hash = mix(hash, r.count + (r.complete ? 256u : 0u));
    for (u32 i = 0; i < r.count; ++i) hash = mix(hash, r.code[i]);
  }
  return hash;
}

}  // namespace tpa
