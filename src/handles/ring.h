// SPDX-License-Identifier: MIT
// ring: handles of keys whose longest polygon has too many vertices for an alternating handle, by arithmetic (paper
// section 4.2). Only for files whose constants the compiler evaluates.
//
// Let e(v) be the number of faces at v less three. The sum of e is 6 (k - 2) in every handle. So the sum of the squared
// numbers of faces is smallest where the cost, the sum of e (e - 1) / 2, is smallest. A vertex with three or four faces
// costs 0, a vertex with two or five costs 1.
//
// The longest polygon, a, surrounds the others. The strips of a, the segments, form a ring around the others; between
// two segments a junction joins two of the other polygons. Along a segment, each vertex of the other polygon inside the
// segment faces a step of a. If a has vertices left over, some of these vertices face a second step, an extra. An extra
// leaves a vertex of a with two faces, at a cost of 1. No other cost arises as long as no vertex takes two extras.
//
// A junction is a strip of at most two steps between two of the other polygons, with the inner triangles at both ends.
// At the end of a segment, either steps of a (`run` of them) face the corner of the other polygon, or a step of the
// other polygon faces the corner of a. The cost of a junction at its corners and the number of extras left to the
// segments balance: an extra costs 1, or 2 where all vertices inside the segments have an extra already. Only junctions
// that are best at either price make minimal handles.
//
// A search of all words, without any knowledge of rings, found as many handles of the same cost for every key.
#pragma once

#include "handles/unequal_row.h"

namespace tpa {

struct Junction {
  u8 x_steps = 0, y_steps = 0;  // between the polygons x and y of its strip
  bool x_first = false;
  u8 run[2][2] = {};  // steps of a that face the corner of x and of y, at each end of the strip
  u8 cost = 0;
  i8 extras = 0;
};

constexpr u32 longest_run = 3;

constexpr i32 corner_cost(const Junction& j) {
  i32 cost = 0, e[2][2] = {};  // of x and y, at each end of the strip
  for (u32 end = 0; end < 2; ++end) {
    cost += vertex_cost((j.run[end][0] == 0 ? 1 : 0) + (j.run[end][1] == 0 ? 1 : 0));  // the corner of a
    for (u32 i = 0; i < 2; ++i) {
      cost += max_of(0, j.run[end][i] - 1);  // vertices of a with two faces
      e[i][end] = j.run[end][i];
    }
  }
  // The first step faces a corner at the start of the strip, the last step a corner at the end.
  const u32 steps = j.x_steps + j.y_steps;
  if (steps > 0) ++e[j.x_first ? 1 : 0][0];
  if (steps > 1) ++e[j.x_first ? 0 : 1][1];
  // A polygon without steps has a single corner here, in both triangles.
  for (u32 i = 0; i < 2; ++i)
    cost += (i == 0 ? j.x_steps : j.y_steps) == 0 ? vertex_cost(e[i][0] + e[i][1] + 1)
                                                  : vertex_cost(e[i][0]) + vertex_cost(e[i][1]);
  return cost;
}

constexpr bool alike(const Junction& a, const Junction& b) {
  return a.cost == b.cost && a.extras == b.extras && a.x_steps + a.y_steps == b.x_steps + b.y_steps;
}

// Alike junctions stand in a row; alike_end[i] is the end of the row with junction i.
struct JunctionList {
  Junction at[32] = {};
  u8 alike_end[32] = {};
  u32 count = 0;
};
constexpr void add(JunctionList& list, const Junction& j) {
  u32 at = list.count++;
  while (at > 0 && !alike(list.at[at - 1], j)) --at;
  if (at == 0) at = list.count - 1;  // the first of its kind
  for (u32 i = list.count - 1; i > at; --i) list.at[i] = list.at[i - 1];
  list.at[at] = j;
}
// Junctions with most steps come first: they make the most even handles.
constexpr JunctionList make_junctions() {
  JunctionList list;
  constexpr u8 x_steps[5] = {1, 1, 1, 0, 0}, y_steps[5] = {1, 1, 0, 1, 0};
  for (u32 word = 0; word < 5; ++word)
    for (u32 runs = 0; runs < 256; ++runs) {
      Junction j{x_steps[word], y_steps[word], x_steps[word] == 1 && word != 1, {}, 0, 0};
      i32 extras = j.x_steps + j.y_steps + 2;
      for (u32 i = 0; i < 4; ++i) {
        const u32 run = (runs >> (2 * i)) & longest_run;
        j.run[i / 2][i % 2] = static_cast<u8>(run), extras -= static_cast<i32>(run);
      }
      const i32 cost = corner_cost(j);
      if (cost + extras != 2 && cost + 2 * extras != 2) continue;
      j.cost = static_cast<u8>(cost), j.extras = static_cast<i8>(extras);
      add(list, j);
    }
  for (u32 i = list.count; i-- > 0;) {
    const bool goes_on = i + 1 < list.count && alike(list.at[i], list.at[i + 1]);
    list.alike_end[i] = static_cast<u8>(goes_on ? list.alike_end[i + 1] : i + 1);
  }
  return list;
}
inline constexpr JunctionList junctions = make_junctions();

// The junction at an end of a segment: its run[end][polygon] faces the corner there.
struct SegmentEnd {
  u8 junction = 0, end = 0, polygon = 0;
};

// A plan whose polygon 0 surrounds the others, with its strips told apart: segments at polygon 0, and joints.
struct RingPlan {
  u8 plan = 0;
  u8 segments = 0, joints = 0;
  u8 segment[4] = {}, joint[2] = {};
  SegmentEnd end[4][2] = {};
};

constexpr RingPlan make_ring(u32 k, u32 index) {
  const Plan& plan = plan_of(k, index);
  RingPlan ring;
  ring.plan = static_cast<u8>(index);
  for (u32 s = 0; s < plan.strips; ++s)
    (plan.x[s] == 0 ? ring.segment[ring.segments++] : ring.joint[ring.joints++]) = static_cast<u8>(s);
  for (u32 i = 0; i < ring.segments; ++i)
    for (u32 at = 0; at < 2; ++at)
      for (u32 j = 0; j < ring.joints; ++j)
        for (u32 end = 0; end < 2; ++end) {
          const u32 s = ring.segment[i], z = ring.joint[j];
          if (plan.triangle_of_slot[2 * z + end] != plan.triangle_of_slot[2 * s + at]) continue;
          ring.end[i][at] = {static_cast<u8>(j), static_cast<u8>(end), u8(plan.y[s] == plan.y[z] ? 1 : 0)};
        }
  return ring;
}

// The rings of four polygons are the row plans with polygon 0 and another polygon between the other two.
struct RingTable {
  RingPlan of_three, of_four[3];
};
constexpr RingTable make_rings() {
  RingTable table;
  table.of_three = make_ring(3, 0);
  for (u32 i = 0; i < 3; ++i) table.of_four[i] = make_ring(4, tetrahedral_plans + i);
  return table;
}
inline constexpr RingTable rings = make_rings();
constexpr u32 ring_count(u32 k) { return k == 4 ? 3 : 1; }
constexpr const RingPlan& ring_of(u32 k, u32 index) { return k == 4 ? rings.of_four[index] : rings.of_three; }

// Cost of `extras` on `vertices`, spread evenly.
constexpr i32 extras_cost(i32 extras, i32 vertices) {
  if (extras == 0) return 0;
  if (vertices == 0) return 1000;  // more than any handle's cost
  const i32 each = extras / vertices, more = extras % vertices;
  return extras + (vertices - more) * vertex_cost(each) + more * vertex_cost(each + 1);
}

// A ring with its junctions chosen, and with the lengths of its first segments.
struct RingShape {
  const RingPlan* ring = nullptr;
  const Junction* junction[2] = {};
  i32 left[max_handle_polygons] = {};  // steps of the polygons not in a strip yet
  i32 extras = 0, faces = 0;           // extras and faces not in a segment yet
  i32 cost = 0;
  u64 unevenness = 0;
  i32 vertices[4] = {}, extra[4] = {};  // inside each segment, of its other polygon
};

constexpr i32 run_at(const RingShape& shape, u32 segment, u32 at) {
  const SegmentEnd& end = shape.ring->end[segment][at];
  return shape.junction[end.junction]->run[end.end][end.polygon];
}

constexpr RingShape join(u32 k, const u32 (&sides)[max_handle_polygons], const RingPlan& ring, const Junction& j0,
                         const Junction& j1) {
  const Plan& plan = plan_of(k, ring.plan);
  RingShape shape{&ring, {&j0, &j1}, {}, 0, 0, 0, is_crowded(plan) ? crowding : 0, {}, {}};
  for (u32 p = 0; p < k; ++p) shape.left[p] = static_cast<i32>(sides[p]);
  shape.extras = shape.left[0] - shape.left[1] - shape.left[2] - shape.left[3];
  for (u32 j = 0; j < ring.joints; ++j) {
    const Junction& chosen = *shape.junction[j];
    const u32 steps = chosen.x_steps + chosen.y_steps;
    shape.left[plan.x[ring.joint[j]]] -= chosen.x_steps, shape.left[plan.y[ring.joint[j]]] -= chosen.y_steps;
    shape.extras += chosen.extras, shape.cost += chosen.cost, shape.unevenness += steps * steps;
  }
  shape.faces = shape.left[0] + shape.left[1] + shape.left[2] + shape.left[3];
  return shape;
}

// Calls `visit` for all shapes of cost `target` with the first s segments of this shape. visit.limit is the largest
// unevenness wanted.
template <class Visit>
constexpr void complete_shape(const Plan& plan, RingShape& shape, u32 s, i32 target, Visit& visit) {
  const RingPlan& ring = *shape.ring;
  if (s == ring.segments) {
    if (shape.cost == target) visit(shape);
    return;
  }
  // The squares are least if the remaining segments share the remaining faces.
  const i32 even_rest = shape.faces * shape.faces / (ring.segments - i32(s));
  if (shape.cost > target || shape.unevenness + u64(even_rest) > visit.limit) return;
  const u32 polygon = plan.y[ring.segment[s]];
  bool last = true;
  for (u32 later = s + 1; later < ring.segments; ++later) last = last && plan.y[ring.segment[later]] != polygon;
  const i32 runs = run_at(shape, s, 0) + run_at(shape, s, 1), left = shape.left[polygon];
  const i32 extras = shape.extras, all_faces = shape.faces, cost = shape.cost;
  const u64 unevenness = shape.unevenness;
  for (i32 steps = last ? left : 1; steps <= (last ? left : left - 1); ++steps) {
    const i32 vertices = steps - 1;
    for (i32 extra = s + 1 == ring.segments ? extras : 0; extra <= extras; ++extra) {
      const i32 a_steps = vertices + runs + extra, faces = a_steps + steps;
      shape.cost = cost + extras_cost(extra, vertices);
      shape.unevenness = unevenness + u64(faces * faces);
      if (shape.cost > target || shape.unevenness > visit.limit) break;
      if (a_steps == 0) continue;
      shape.left[polygon] = left - steps, shape.extras = extras - extra, shape.faces = all_faces - faces;
      shape.vertices[s] = vertices, shape.extra[s] = extra;
      complete_shape(plan, shape, s + 1, target, visit);
    }
  }
  shape.left[polygon] = left, shape.extras = extras, shape.faces = all_faces;
  shape.cost = cost, shape.unevenness = unevenness;
}

// Calls `visit` with the places of one junction of each kind, and for k = 4 of every two kinds.
template <class Visit>
constexpr void visit_kinds(u32 k, Visit&& visit) {
  const u32 count = junctions.count, seconds = k == 4 ? count : 1;
  for (u32 i = 0; i < count; i = junctions.alike_end[i])
    for (u32 j = 0; j < seconds; j = junctions.alike_end[j]) visit(i, j);
}

// Least cost of a ring with these two junctions, or for k = 3 with the first: its extras spread over all vertices
// evenly. Alike junctions cost the same.
constexpr i32 joints_cost(u32 k, const u32 (&sides)[max_handle_polygons], const Junction& j0, const Junction& j1) {
  const i32 others = static_cast<i32>(sides[1] + sides[2] + sides[3]);
  i32 extras = static_cast<i32>(sides[0]) - others + j0.extras, cost = j0.cost;
  i32 vertices = others - 2 * (static_cast<i32>(k) - 2) - j0.x_steps - j0.y_steps;
  if (k == 4) extras += j1.extras, cost += j1.cost, vertices -= j1.x_steps + j1.y_steps;
  return extras < 0 || vertices < 0 ? INT32_MAX : cost + extras_cost(extras, vertices);
}

// The cost of the cheapest ring; INT32_MAX without any ring.
constexpr i32 least_ring_cost(u32 k, const u32 (&sides)[max_handle_polygons]) {
  i32 least = INT32_MAX;
  visit_kinds(k, [&](u32 i, u32 j) { least = min_of(least, joints_cost(k, sides, junctions.at[i], junctions.at[j])); });
  return least;
}

// Least unevenness of a handle with these junctions: all segments have equal numbers of faces.
constexpr u64 joints_unevenness(u32 k, const u32 (&sides)[max_handle_polygons], const Junction& j0,
                                const Junction& j1) {
  const u32 steps0 = j0.x_steps + j0.y_steps, steps1 = k == 4 ? j1.x_steps + j1.y_steps : 0;
  const u32 faces = sides[0] + sides[1] + sides[2] + sides[3] - steps0 - steps1;
  return (k == 4 ? crowding : 0) + steps0 * steps0 + steps1 * steps1 + faces * faces / (2 * k - 4);
}

// Calls `visit` for all rings with these two junctions, or the first, of cost `target`.
template <class Visit>
constexpr void visit_joined(u32 k, const u32 (&sides)[max_handle_polygons], i32 target, const ExchangeList& list,
                            const Junction& j0, const Junction& j1, Visit& visit) {
  for (u32 r = 0; r < ring_count(k); ++r) {
    const RingPlan& ring = ring_of(k, r);
    if (!plan_has_generators(k, ring.plan, list)) continue;
    RingShape shape = join(k, sides, ring, j0, j1);
    complete_shape(plan_of(k, ring.plan), shape, 0, target, visit);
  }
}

// Calls `visit` for all rings of the least cost, `target`.
template <class Visit>
constexpr void visit_rings(u32 k, const u32 (&sides)[max_handle_polygons], i32 target, const ExchangeList& list,
                           Visit& visit) {
  visit_kinds(k, [&](u32 i, u32 j) {
    const Junction &j0 = junctions.at[i], &j1 = junctions.at[j];
    if (joints_unevenness(k, sides, j0, j1) > visit.limit || joints_cost(k, sides, j0, j1) != target) return;
    for (u32 a = i; a < junctions.alike_end[i]; ++a)
      for (u32 b = j; b < (k == 4 ? junctions.alike_end[j] : 1u); ++b)
        visit_joined(k, sides, target, list, junctions.at[a], junctions.at[b], visit);
  });
}

constexpr u32 choose(u32 n, u32 r) {
  u32 ways = 1;
  for (u32 i = 0; i < r; ++i) ways = ways * (n - i) / (i + 1);
  return ways;
}

// Finds the unevenness up to which at least `wanted` words exist.
struct LimitFinder {
  u64 limit = UINT64_MAX;
  u32 wanted = 0;
  u64 value[128] = {};  // in order, with the number of words of each
  u32 words[128] = {};
  u32 count = 0;
  constexpr void operator()(const RingShape& shape) {
    u32 ways = 1, at = 0;
    for (u32 s = 0; s < shape.ring->segments; ++s)
      if (shape.extra[s] > 0)
        ways *= choose(static_cast<u32>(shape.vertices[s]), static_cast<u32>(shape.extra[s] % shape.vertices[s]));
    while (at < count && value[at] < shape.unevenness) ++at;
    if (at == count || value[at] != shape.unevenness) {
      for (u32 i = count++; i > at; --i) value[i] = value[i - 1], words[i] = words[i - 1];
      value[at] = shape.unevenness, words[at] = 0;
    }
    words[at] += ways;
    u32 sum = 0;
    for (u32 i = 0; i < count; ++i) {
      sum += words[i];
      if (sum >= wanted) count = i + 1, limit = value[i];
    }
  }
};

// Writes the words of a shape strip by strip. Vertices inside a segment with one step more than the others are chosen
// in every way.
struct WordWriter {
  u64 limit = UINT64_MAX;
  WordBuilder& row;

  constexpr void operator()(const RingShape& shape) {
    WordHandle word;
    word.plan = shape.ring->plan;
    write(shape, word, 0, 0, 0, 0);
  }

  // `segment`, `joint` and `strip` count the parts written so far.
  constexpr void write(const RingShape& shape, WordHandle word, u32 segment, u32 joint, u32 strip, u32 bit) {
    const Plan& plan = plan_of(row.k, word.plan);
    if (strip == plan.strips) return insert(row, word, shape.unevenness);
    if (plan.x[strip] != 0) {
      const Junction& j = *shape.junction[joint];
      word.x_steps[strip] = j.x_steps, word.y_steps[strip] = j.y_steps;
      if (j.x_steps > 0) word.steps |= u64{1} << (bit + (j.x_first ? 0 : j.y_steps));
      return write(shape, word, segment, joint + 1, strip + 1, bit + j.x_steps + j.y_steps);
    }
    const u32 vertices = static_cast<u32>(shape.vertices[segment]);
    const u32 extra = static_cast<u32>(shape.extra[segment]);
    const u32 first = static_cast<u32>(run_at(shape, segment, 0));
    const u32 last = static_cast<u32>(run_at(shape, segment, 1));
    const u32 each = vertices == 0 ? 1 : 1 + extra / vertices, more = vertices == 0 ? 0 : extra % vertices;
    word.y_steps[strip] = static_cast<u8>(vertices + 1);
    word.x_steps[strip] = static_cast<u8>(first + vertices + extra + last);
    const u32 end = bit + word.x_steps[strip] + word.y_steps[strip];
    for (u32 chosen = (1u << more) - 1; chosen < 1u << vertices; chosen = next_choice(chosen)) {
      WordHandle next = word;
      next.steps |= runs_word(first, last, vertices, each, chosen) << bit;
      write(shape, next, segment + 1, joint, strip + 1, end);
    }
  }
};

constexpr void gather_rings(u32 k, const u32 (&sides)[max_handle_polygons], WordBuilder& row) {
  const i32 target = least_ring_cost(k, sides);
  if (target == INT32_MAX) return;
  LimitFinder finder;
  finder.wanted = (row_capacity + 1) * (row.exchanges.count + 1);  // enough to drop one
  visit_rings(k, sides, target, row.exchanges, finder);
  WordWriter writer{finder.limit, row};
  visit_rings(k, sides, target, row.exchanges, writer);
}

}  // namespace tpa
