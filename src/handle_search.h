// handle_search: the handles of keys whose polygons are so unequal that no alternating handle exists (paper
// section 4.2). Included only where the compiler evaluates it; nothing here runs in a program, least of all
// recursion.
//
// Write e(v) for the number of faces at v less three. The sum of e is 6 (k - 2) in every handle, so the sum
// of the squared numbers of faces is smallest where the sum of e (e - 1) / 2 is: a vertex with three or four
// faces costs nothing, one with two or five costs one. The search walks through plan, strips and words and
// gives up a branch when what it has spent, and a lower bound for what is left, exceed the target.
#pragma once

#include "handle_exchange.h"

namespace tpa {

// The sides that the search is made for.
inline constexpr u32 searched_side = 16;

// What collects the handles: `found(word)` returns false to stop the search.
template <class Found>
struct HandleSearch {
  u32 k;
  const u32 (&sides)[max_handle_polygons];
  i32 target;
  const Found& found;
  const Plan* plan = nullptr;
  WordHandle word = {};
  i32 p[max_plan_strips] = {}, q[max_plan_strips] = {};
  u32 at[max_handle_polygons][max_plan_strips] = {};  // where strips start
  i32 e[max_handle_polygons][searched_side] = {};     // faces counted so far, less three
  i32 spent = 0;
  i32 ahead[max_plan_strips] = {};  // a lower bound for the strips after each, as it was when that was begun
  u32 bit = 0;
  bool stopped = false;
};

constexpr i32 least_strip_cost(i32 p, i32 q) { return max_of(0, (p < q ? q - p : p - q) - 1); }

// One more step faces vertex v of polygon x.
template <class Found>
constexpr i32 face_vertex(HandleSearch<Found>& search, u32 x, u32 v) {
  const i32 cost = max_of(0, search.e[x][v]++);
  search.spent += cost;
  return cost;
}
template <class Found>
constexpr void unface_vertex(HandleSearch<Found>& search, u32 x, u32 v, i32 cost) {
  --search.e[x][v];
  search.spent -= cost;
}

// A lower bound for a strip not begun: its ends give one step each to a corner, either way, and what
// imbalance the inner vertices then have to bear costs one a step.
template <class Found>
constexpr i32 least_cost_ahead(const HandleSearch<Found>& search, u32 s) {
  const i32 p = search.p[s], q = search.q[s];
  if (p == 0 || q == 0) return least_strip_cost(p, q);
  const u32 x = search.plan->x[s], y = search.plan->y[s], m = search.sides[x], n = search.sides[y];
  const u32 xs = search.at[x][s], ys = search.at[y][s];
  const i32 x_start = max_of(0, search.e[x][xs % m]), x_end = max_of(0, search.e[x][(xs + u32(p)) % m]);
  const i32 y_start = max_of(0, search.e[y][(ys + u32(q)) % n]), y_end = max_of(0, search.e[y][ys % n]);
  const auto inner = [p, q](i32 on_y) { return max_of(0, p + 1 - q - on_y) + max_of(0, q - 1 - p + on_y); };
  return min_of(min_of(y_start + y_end + inner(2), x_start + x_end + inner(0)),
                min_of(x_start + y_end, y_start + x_end) + inner(1));
}

// The same for the rest of a strip, u steps on x and w on y being left.
template <class Found>
constexpr i32 least_cost_within(const HandleSearch<Found>& search, u32 s, i32 i, i32 j, u32 xi, u32 yj) {
  const i32 u = search.p[s] - i, w = search.q[s] - j;
  if (u == 0 || w == 0) return max_of(0, u + w - 1);
  const u32 x = search.plan->x[s], y = search.plan->y[s];
  const i32 x_bare = i > 0 && search.e[x][xi]<0, y_bare = j> 0 && search.e[y][yj] < 0;
  const u32 x_end = (search.at[x][s] + u32(search.p[s])) % search.sides[x],
            y_end = search.at[y][s] % search.sides[y];
  const i32 ends_on_y =
      max_of(0, search.e[y][y_end]) + max_of(0, u - 1 + x_bare - w) + max_of(0, w + y_bare - u);
  const i32 ends_on_x =
      max_of(0, search.e[x][x_end]) + max_of(0, u + x_bare - w) + max_of(0, w - 1 + y_bare - u);
  return min_of(ends_on_y, ends_on_x);
}

// Is no edge there twice? Only strips that go all round a polygon, and twin strips, can make one.
constexpr bool edges_differ(u32 k, const u32 (&sides)[max_handle_polygons], const WordHandle& word) {
  const Plan& plan = plan_of(k, word.plan);
  u32 x_steps[6] = {}, y_steps[6] = {};
  for (u32 s = 0; s < plan.strips; ++s) x_steps[s] = word.x_steps[s], y_steps[s] = word.y_steps[s];
  const StripStarts starts = strip_starts(plan, x_steps, y_steps);
  for (u32 s = 0, bit = 0; s < plan.strips; ++s) {
    const u32 x = plan.x[s], y = plan.y[s];
    // Twins are strips 1 and 3 of a row plan; the others have their polygons for themselves.
    u32 seen[searched_side] = {};
    u32 i = starts.at[x][s], j = starts.at[y][s] + y_steps[s];
    const u32 steps = x_steps[s] + y_steps[s];
    for (u32 t = 0;; ++t) {
      const u32 mark = 1u << (j % sides[y]);
      if (seen[i % sides[x]] & mark) return false;
      seen[i % sides[x]] |= mark;
      if (t == steps) break;
      (word.steps >> bit++) & 1 ? ++i : --j;
    }
    if (s != 1 || plan.polygons != 4 || plan.degree[x] != 4) continue;
    i = starts.at[x][3], j = starts.at[y][3] + y_steps[3];
    u32 twin_bit = bit + x_steps[2] + y_steps[2];
    for (u32 t = 0;; ++t) {
      if (seen[i % sides[x]] & (1u << (j % sides[y]))) return false;
      if (t == x_steps[3] + y_steps[3]) break;
      (word.steps >> twin_bit++) & 1 ? ++i : --j;
    }
  }
  return true;
}

template <class Found>
constexpr void search_words(HandleSearch<Found>& search, u32 s, i32 i, i32 j);

template <class Found>
constexpr void search_strip(HandleSearch<Found>& search, u32 s) {
  if (s == search.plan->strips) {
    if (search.spent == search.target && edges_differ(search.k, search.sides, search.word))
      search.stopped = !search.found(search.word);
    return;
  }
  search.ahead[s] = 0;
  for (u32 z = s + 1; z < search.plan->strips; ++z) search.ahead[s] += least_cost_ahead(search, z);
  if (search.spent + search.ahead[s] + least_cost_ahead(search, s) <= search.target)
    search_words(search, s, 0, 0);
}

template <class Found>
constexpr void search_words(HandleSearch<Found>& search, u32 s, i32 i, i32 j) {
  if (search.stopped) return;
  const i32 p = search.p[s], q = search.q[s];
  if (i == p && j == q) return search_strip(search, s + 1);
  const u32 x = search.plan->x[s], y = search.plan->y[s], m = search.sides[x], n = search.sides[y];
  const u32 xi = (search.at[x][s] + u32(i)) % m, yj = (search.at[y][s] + u32(q - j)) % n;
  if (search.spent + search.ahead[s] + least_cost_within(search, s, i, j, xi, yj) > search.target) return;
  ++search.bit;
  const u64 mark = u64{1} << (search.bit - 1);
  if (i < p) {
    const i32 bare = i > 0 && search.e[x][xi] < 0;
    const i32 cost = face_vertex(search, y, yj);
    search.spent += bare;
    search.word.steps |= mark;
    if (search.spent <= search.target) search_words(search, s, i + 1, j);
    search.word.steps &= ~mark;
    search.spent -= bare;
    unface_vertex(search, y, yj, cost);
  }
  if (j < q) {
    const i32 bare = j > 0 && search.e[y][yj] < 0;
    const i32 cost = face_vertex(search, x, xi);
    search.spent += bare;
    if (search.spent <= search.target) search_words(search, s, i, j + 1);
    search.spent -= bare;
    unface_vertex(search, x, xi, cost);
  }
  --search.bit;
}

// All strips have their steps: places them and counts the inner triangles' corners.
template <class Found>
constexpr void place_strips(HandleSearch<Found>& search) {
  const Plan& plan = *search.plan;
  for (u32 x = 0; x < search.k; ++x)
    for (u32 v = 0; v < search.sides[x]; ++v) search.e[x][v] = -1;
  search.spent = 0;
  for (u32 x = 0; x < search.k; ++x) {
    u32 position = 0;
    for (u32 t = 0; t < plan.degree[x]; ++t) {
      const u32 s = plan.around[x][t];
      search.at[x][s] = position;
      search.spent += max_of(0, search.e[x][position % search.sides[x]]++);
      position += static_cast<u32>(plan.x[s] == x ? search.p[s] : search.q[s]);
    }
  }
}

// Hands every handle of cost `target` with the lengths that `search` holds to `found`.
template <class Found>
constexpr void search_lengths(HandleSearch<Found>& search) {
  place_strips(search);
  for (u32 s = 0; s < search.plan->strips; ++s) {
    search.word.x_steps[s] = static_cast<u8>(search.p[s]);
    search.word.y_steps[s] = static_cast<u8>(search.q[s]);
  }
  search_strip(search, 0);
}

}  // namespace tpa
