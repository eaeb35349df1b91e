// SPDX-License-Identifier: MIT
// words: how a handle is written down (paper section 4.2).
//
// No edge of a useful handle joins two vertices of one polygon. Shrunk to points, the k polygons then become the
// vertices of a triangulation of the sphere, the plan of the handle. An edge of the plan is a strip: a band of faces
// between two polygons x and y, read in the direction of x as a word of steps. Each step consumes one edge of x
// (forwards) or one edge of y (backwards). The 2k - 4 triangles of the plan are the inner triangles of the handle, at
// the ends of the strips.
//
// The vertices of a polygon are numbered in the direction in which the faces of the handle traverse its edges. The
// handle printed in the paper for (5, 4, 3) obeys this rule once its faces are oriented so that the first reads 1 -> 2
// -> 11; the paper prints faces with sorted numbers.
//
// All functions are constexpr: the compiler makes the tables.
#pragma once

#include "base/base.h"

namespace tpa {

inline constexpr u32 max_handle_polygons = 4;
inline constexpr u32 max_plan_strips = 6;
inline constexpr u32 max_plan_triangles = 4;

// A plan: how the strips of a handle lie between its polygons. Strip s lies between polygons x[s] and y[s]; around[X]
// lists the strips at X in its own direction, beginning with the strip at vertex 0. Slot 2s is the start of strip s and
// slot 2s + 1 its end, in the direction of x. A slot is also a directed edge of an inner triangle: x -> y at the start,
// y -> x at the end.
struct Plan {
  u8 polygons = 0;
  u8 strips = 0;
  u8 triangles = 0;
  u8 x[max_plan_strips] = {};
  u8 y[max_plan_strips] = {};
  u8 degree[max_handle_polygons] = {};
  u8 around[max_handle_polygons][4] = {};
  u8 triangle_of_slot[2 * max_plan_strips] = {};
  u8 slots_of_triangle[max_plan_triangles][3] = {};
};

constexpr u32 slot_head(const Plan& plan, u32 slot) { return (slot & 1) ? plan.x[slot / 2] : plan.y[slot / 2]; }

// The slot at which strip s begins in the direction of the polygon.
constexpr u32 opening_slot(const Plan& plan, u32 polygon, u32 s) { return plan.x[s] == polygon ? 2 * s : 2 * s + 1; }

// The directed edge after `slot` in its triangle: there the next strip around the polygon at the slot's head begins.
constexpr u32 next_slot(const Plan& plan, u32 slot) {
  const u32 head = slot_head(plan, slot);
  u32 at = 0;
  while (plan.around[head][at] != slot / 2) ++at;
  return opening_slot(plan, head, plan.around[head][(at + 1) % plan.degree[head]]);
}

constexpr void trace_triangles(Plan& plan) {
  bool seen[2 * max_plan_strips] = {};
  for (u32 slot = 0; slot < 2u * plan.strips; ++slot) {
    if (seen[slot]) continue;
    u32 at = slot;
    for (u32 c = 0; c < 3; ++c) {
      seen[at] = true;
      plan.triangle_of_slot[at] = plan.triangles;
      plan.slots_of_triangle[plan.triangles][c] = static_cast<u8>(at);
      at = next_slot(plan, at);
    }
    ++plan.triangles;
  }
}

constexpr u32 plan_count(u32 k) { return k == 4 ? 8 : 1; }
// Plans 0 and 1 of four polygons are the tetrahedron and its mirror image, vertex degrees (3,3,3,3). The other six have
// degrees (4,4,2,2), for polygons in a row: a and b have two strips between them, with c and d between these strips.
inline constexpr u32 tetrahedral_plans = 2;

constexpr Plan make_tetrahedral_plan(bool mirrored) {
  Plan plan;
  plan.polygons = 4;
  plan.strips = 6;
  constexpr u8 x[6] = {0, 0, 0, 1, 1, 2}, y[6] = {1, 2, 3, 2, 3, 3};
  constexpr u8 around[4][3] = {{0, 1, 2}, {0, 4, 3}, {1, 3, 5}, {2, 5, 4}};
  for (u32 s = 0; s < 6; ++s) plan.x[s] = x[s], plan.y[s] = y[s];
  for (u32 p = 0; p < 4; ++p) {
    plan.degree[p] = 3;
    for (u32 t = 0; t < 3; ++t) plan.around[p][t] = around[p][mirrored ? (3 - t) % 3 : t];
  }
  trace_triangles(plan);
  return plan;
}

constexpr Plan make_row_plan(u8 a, u8 b, u8 c, u8 d) {
  Plan plan;
  plan.polygons = 4;
  plan.strips = 6;
  const u8 x[6] = {a, a, a, a, b, b}, y[6] = {c, b, d, b, c, d};
  constexpr u8 wide[2][4] = {{0, 1, 2, 3}, {1, 4, 3, 5}};
  constexpr u8 narrow[2][2] = {{0, 4}, {2, 5}};
  for (u32 s = 0; s < 6; ++s) plan.x[s] = x[s], plan.y[s] = y[s];
  plan.degree[a] = plan.degree[b] = 4;
  plan.degree[c] = plan.degree[d] = 2;
  for (u32 t = 0; t < 4; ++t) plan.around[a][t] = wide[0][t], plan.around[b][t] = wide[1][t];
  for (u32 t = 0; t < 2; ++t) plan.around[c][t] = narrow[0][t], plan.around[d][t] = narrow[1][t];
  trace_triangles(plan);
  return plan;
}

constexpr Plan make_plan(u32 k, u32 index) {
  Plan plan;
  plan.polygons = static_cast<u8>(k);
  if (k == 2) {  // one strip that closes on itself, no inner triangle
    plan.strips = plan.degree[0] = plan.degree[1] = plan.y[0] = 1;
    return plan;
  }
  if (k == 3) {
    plan.strips = 3;
    constexpr u8 x[3] = {0, 1, 0}, y[3] = {1, 2, 2}, around[3][2] = {{0, 2}, {1, 0}, {2, 1}};
    for (u32 s = 0; s < 3; ++s) {
      plan.x[s] = x[s], plan.y[s] = y[s], plan.degree[s] = 2;
      for (u32 t = 0; t < 2; ++t) plan.around[s][t] = around[s][t];
    }
    trace_triangles(plan);
    return plan;
  }
  if (index < tetrahedral_plans) return make_tetrahedral_plan(index == 1);
  constexpr u8 rows[6][4] = {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}};
  const u8(&row)[4] = rows[index - tetrahedral_plans];
  return make_row_plan(row[0], row[1], row[2], row[3]);
}

struct PlanTable {
  Plan of_two, of_three, of_four[8];
};
constexpr PlanTable make_plans() {
  PlanTable table;
  table.of_two = make_plan(2, 0);
  table.of_three = make_plan(3, 0);
  for (u32 i = 0; i < 8; ++i) table.of_four[i] = make_plan(4, i);
  return table;
}
inline constexpr PlanTable plans = make_plans();
constexpr const Plan& plan_of(u32 k, u32 index) {
  return k == 2 ? plans.of_two : k == 3 ? plans.of_three : plans.of_four[index];
}

// A handle between polygons short enough that all steps fit 64 bits. Bit t of `steps` is step t,
// counted through the strips in order, 1 for an x-step.
struct WordHandle {
  u8 plan = 0;
  u8 x_steps[max_plan_strips] = {};
  u8 y_steps[max_plan_strips] = {};
  u64 steps = 0;
};

// The same in sixteen bytes, for tables of polygons of at most 15 sides.
struct PackedWords {
  u64 steps = 0;
  u8 steps_of_strip[max_plan_strips] = {};  // on x in the low half, on y in the high half
  u8 plan = 0;
};
constexpr PackedWords pack(const WordHandle& handle) {
  PackedWords packed;
  packed.plan = handle.plan, packed.steps = handle.steps;
  for (u32 s = 0; s < max_plan_strips; ++s)
    packed.steps_of_strip[s] = static_cast<u8>(handle.x_steps[s] | handle.y_steps[s] << 4);
  return packed;
}
constexpr WordHandle unpack(const PackedWords& packed) {
  WordHandle handle;
  handle.plan = packed.plan, handle.steps = packed.steps;
  for (u32 s = 0; s < max_plan_strips; ++s)
    handle.x_steps[s] = packed.steps_of_strip[s] & 15, handle.y_steps[s] = packed.steps_of_strip[s] >> 4;
  return handle;
}

// How the polygons of a plan are numbered: their sides, the number of vertex 0 of each, and the rotation of each, less
// than its sides.
struct Placement {
  u32 sides[max_handle_polygons] = {};
  u32 first[max_handle_polygons] = {};
  u32 rotation[max_handle_polygons] = {};
};
constexpr u32 placed(const Placement& at, u32 polygon, u32 position) {
  return at.first[polygon] + (position + at.rotation[polygon]) % at.sides[polygon];
}

// Start of strip s on polygon p, in the direction of the polygon.
struct StripStarts {
  u32 at[max_handle_polygons][max_plan_strips] = {};
};
constexpr StripStarts strip_starts(const Plan& plan, const u32 (&x_steps)[6], const u32 (&y_steps)[6]) {
  StripStarts starts;
  for (u32 p = 0; p < plan.polygons; ++p) {
    u32 position = 0;
    for (u32 t = 0; t < plan.degree[p]; ++t) {
      const u32 s = plan.around[p][t];
      starts.at[p][s] = position;
      position += plan.x[s] == p ? x_steps[s] : y_steps[s];
    }
  }
  return starts;
}

// Writes the faces of a handle, strips in order, then inner triangles; returns their number. Pre: `out` has room for mu
// + 2k - 4 faces.
constexpr u32 write_faces(u32 k, const WordHandle& handle, const Placement& at, FaceCorners* out) {
  const Plan& plan = plan_of(k, handle.plan);
  u32 x_steps[6] = {}, y_steps[6] = {};
  for (u32 s = 0; s < 6; ++s) x_steps[s] = handle.x_steps[s], y_steps[s] = handle.y_steps[s];
  const StripStarts starts = strip_starts(plan, x_steps, y_steps);
  u32 count = 0;
  u64 steps = handle.steps;
  for (u32 s = 0; s < plan.strips; ++s) {
    const u32 x = plan.x[s], y = plan.y[s];
    const u32 x0 = starts.at[x][s], y0 = starts.at[y][s] + y_steps[s];
    for (u32 i = 0, j = 0; i < x_steps[s] || j < y_steps[s]; steps >>= 1) {
      const u32 a = placed(at, x, x0 + i), b = placed(at, y, y0 - j);
      if ((steps & 1) != 0)
        out[count++] = {{a, placed(at, x, x0 + ++i), b}};
      else
        out[count++] = {{placed(at, y, y0 - ++j), b, a}};
    }
  }
  for (u32 t = 0; t < plan.triangles; ++t) {
    for (u32 c = 0; c < 3; ++c) {
      const u32 slot = plan.slots_of_triangle[t][c], head = slot_head(plan, slot);
      out[count].v[c] = placed(at, head, starts.at[head][next_slot(plan, slot) / 2]);
    }
    ++count;
  }
  return count;
}

}  // namespace tpa
