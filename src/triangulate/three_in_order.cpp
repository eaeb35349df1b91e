// three_in_order: bases and inner triangles, as far as they can be among the best (docs/handles.md).
#include "triangulate/three_in_order.h"

namespace tpa {

namespace {

// Units of work, each about .05 microseconds: so many steps of a table, and asking about a face, a query of the mesh.
constexpr u64 steps_of_a_unit = 64, work_of_a_question = 4;

// Behind the tables, which have taken so many bytes.
u64 carve(ThreeScratch& s, u8* base, u64 tables, u32 longest, u32 vertices) {
  Carver carver{base, three_alignment, tables};
  const u64 n = longest + 1;
  carver.take(s.strip_a, n * n), carver.take(s.strip_b, n * n);
  carver.take(s.least_a, n), carver.take(s.least_b, n), carver.take(s.line, n);
  carver.take(s.bound[0], n), carver.take(s.bound[1], n);
  carver.take(s.part, ThreeScratch::most_parts);
  carver.take(s.step, u64{vertices} + 2);
  carver.take(s.inner, 1), carver.take(s.searched, 1);
  return carver.bytes;
}

// For bounds. Less than far_away in any case.
f32 most_bound(const ThreeSearch& x) {
  const f64 most = allowed(x) * (1.0 + static_cast<f64>(three_slack(x.s.tables.vertices)));
  return static_cast<f32>(min_of(most, 0.25 * static_cast<f64>(far_away)));
}

bool inner_is_free(ThreeSearch& x, u32 a, u32 b, u32 c) {
  if (x.loops.filter.ask == nullptr) return true;
  if (x.hand.view.mirrored) swap_values(b, c);
  const u32 face = (a * most_three_vertices + b) * most_three_vertices + c;
  const u32 place = (face * 2654435761u) >> 23;
  static_assert(InnerAnswers::count == 1u << 9);
  InnerAnswers& known = *x.s.inner;
  if (known.face[place] != face) {
    x.work += work_of_a_question;
    known.face[place] = face, known.free[place] = is_free(x.loops.filter, a, b, c);
  }
  return known.free[place];
}

// ---------------------------------------------------------------- inner triangles

void fill_strips(ThreeSearch& x) {
  const ThreeTables& t = x.s.tables;
  const u32 i = x.hand.from_a, j = x.hand.from_b, c = x.hand.from_c;
  fill_three_strip(x.loops, t, {t.a, t.edge_a, i, t.p, c, true, x.s.strip_a}, x.s.line);
  x.work += (i + 1) * (t.r + 1) / steps_of_a_unit + 1;
  const auto least_of = [&t](const f64* row) {
    f64 least = no_way;
    for (u32 k = 0; k <= t.r; ++k) least = min_of(least, row[k]);
    return least;
  };
  for (u32 u = 0; u <= i; ++u) x.s.least_a[u] = least_of(x.s.strip_a + u * (t.r + 1));
  if (x.measured_b == j && x.measured_c == c) return;
  x.measured_b = j, x.measured_c = c;
  fill_three_strip(x.loops, t, {t.b, t.edge_b, j, t.q, c, false, x.s.strip_b}, x.s.line);
  x.work += (j + 1) * (t.r + 1) / steps_of_a_unit + 1;
  for (u32 w = 0; w <= j; ++w) x.s.least_b[w] = least_of(x.s.strip_b + w * (t.r + 1));
}

// The second triangle, by its places and the steps on C that lead there, and the bound of the handles with both.
struct SecondTriangle {
  u32 i = none, j = none, k = none;
  f64 bound = no_way;
};

// Visits all second triangles that can still be among the best.
template <class Visit>
void each_second(ThreeSearch& x, const Visit& visit) {
  const ThreeTables& t = x.s.tables;
  const u32 i = x.hand.from_a, j = x.hand.from_b;
  const f64 before = t.before[j * t.wide_p + i];
  for (u32 to_i = 0; to_i <= i && !is_done(x); ++to_i) {
    const f64 sofar = before + x.s.least_a[i - to_i], *strip_a = x.s.strip_a + (i - to_i) * (t.r + 1);
    x.work += j / steps_of_a_unit + 1;
    for (u32 to_j = 0; to_j <= j; ++to_j) {
      const f64 after = t.after[to_i * t.wide_q + to_j], *strip_b = x.s.strip_b + (j - to_j) * (t.r + 1);
      // Nor may a strip take all steps of A and of B.
      if (sofar + (after + x.s.least_b[j - to_j]) >= too_long(x) || (to_i == i && to_j == j)) continue;
      x.work += t.r / steps_of_a_unit + 1;
      for (u32 k = 0; k <= t.r; ++k) visit({to_i, to_j, k, before + after + (strip_a[k] + strip_b[t.r - k])});
    }
  }
}

void search_second(ThreeSearch& x, const SecondTriangle& s) {
  const ThreeTables& t = x.s.tables;
  if (s.bound >= too_long(x)) return;
  x.hand.to_a = static_cast<u16>(s.i), x.hand.to_b = static_cast<u16>(s.j), x.hand.steps_c = static_cast<u16>(s.k);
  if (inner_is_free(x, t.a[s.i], t.c[(x.hand.from_c + s.k) % t.r], t.b[s.j])) search_strips(x);
}

void forget_searched(SearchedSet& set) {
  for (u32& triangle : set.triangle) triangle = none;
  set.count = 0;
}
// False where it has been entered before.
bool enter_searched(SearchedSet& set, u32 triangle) {
  u32 place = (triangle * 2654435761u) >> 21;
  static_assert(SearchedSet::capacity == 1u << 11);
  for (; set.triangle[place] != none; place = (place + 1) % SearchedSet::capacity)
    if (set.triangle[place] == triangle) return false;
  if (set.count < SearchedSet::most) set.triangle[place] = triangle, ++set.count;
  return true;
}

void search_first(ThreeSearch& x, u32 i, u32 j, u32 c) {
  const ThreeTables& t = x.s.tables;
  if (!enter_searched(*x.s.searched, (c * (t.q + 1) + j) * t.p + i)) return;
  x.hand.from_a = static_cast<u16>(i), x.hand.from_b = static_cast<u16>(j), x.hand.from_c = static_cast<u16>(c);
  if (!inner_is_free(x, t.a[i], t.b[j], t.c[c])) return;
  fill_strips(x);
  SecondTriangle best;  // first, so that fewer of the others need be searched
  each_second(x, [&best](const SecondTriangle& s) {
    if (s.bound < best.bound) best = s;
  });
  if (best.i == none) return;
  search_second(x, best);
  each_second(x, [&x, &best](const SecondTriangle& s) {
    if (s.i != best.i || s.j != best.j || s.k != best.k) search_second(x, s);
  });
}

// All first triangles at a place of C that can still be among the best.
void search_place(ThreeSearch& x, const ThreePart& part, u32 c) {
  ThreeTables& t = x.s.tables;
  step_back(part, c, t);
  for (u32 i = 0; i < t.p; ++i) t.entry[i] = static_cast<f64>(t.line_a[1][i] + t.ca[c * t.wide_p + i]);
  for (u32 j = 0; j <= t.q; ++j) {
    const f64 reached = static_cast<f64>(t.reached[c * t.wide_q + j]), *before = t.before + j * t.wide_p;
    for (u32 i = 0; i < t.p; ++i)
      if (reached + (before[i] + t.entry[i]) <= static_cast<f64>(most_bound(x)) && !is_done(x))
        search_first(x, i, j, c);
  }
}

constexpr u64 work_of_a_round(u64 p, u64 q, u64 r) { return r * (p * q / steps_of_a_unit + (p + q) / 8 + 1); }
u64 work_of_a_round(const ThreeTables& t) { return work_of_a_round(t.p, t.q, t.r); }

// A base's handles by where their way round C begins: parts are halved as long as they can hold one of the best.
void search_base(ThreeSearch& x) {
  constexpr u32 smallest = 2;
  ThreeTables& t = x.s.tables;
  forget_searched(*x.s.searched);
  Stack<ThreePart> parts{x.s.part, ThreeScratch::most_parts};
  parts.push({0, count_places(t)});
  while (!parts.empty() && !is_done(x)) {
    const ThreePart part = parts.pop();
    x.work += work_of_a_round(t);
    if (bound_part(part, t) > most_bound(x)) continue;
    const u32 middle = (part.begin + part.end) / 2;
    if (part.end - part.begin > smallest) {
      parts.push({middle, part.end}), parts.push({part.begin, middle});
      continue;
    }
    x.work += work_of_a_round(t);
    for (u32 c = t.r; c-- > 0 && !is_done(x);) search_place(x, part, c);
  }
}

void open_base(ThreeSearch& x, bool mirrored, u32 apex) {
  x.hand.view.mirrored = mirrored, x.hand.apex = static_cast<u16>(apex);
  set_places(x.loops, x.hand.view, apex, x.s.tables);
  measure_base(x.loops, x.s.tables);
  x.measured_b = x.measured_c = none;
}

u32 apex_count(const ThreeSearch& x) {
  const ThreeView& v = x.hand.view;
  return x.loops.sides((v.loop + (v.mirrored ? 2 : 1)) % 3);
}

f32 bound_base(ThreeSearch& x) {
  x.work += 2 * work_of_a_round(x.s.tables);
  return bound_part({0, count_places(x.s.tables)}, x.s.tables);
}

// Bounds for all bases of a view, from what places are worth to one base in four, the nearest one. Returns the least.
f32 bound_bases(ThreeSearch& x, bool mirrored) {
  constexpr u32 stride = 4;
  ThreeTables& t = x.s.tables;
  f32 least = far_away;
  x.hand.view.mirrored = mirrored;
  const u32 apexes = apex_count(x);
  for (u32 known = 0; known < apexes; known += stride)
    for (u32 apex = known; apex < min_of(known + stride, apexes); ++apex) {
      open_base(x, mirrored, apex);
      if (apex == known)
        find_worth(t), lend_worth(t);
      else
        borrow_worth(t, static_cast<i32>(known) - static_cast<i32>(apex));
      x.s.bound[mirrored][apex] = is_done(x) ? 0 : bound_base(x);
      least = min_of(least, x.s.bound[mirrored][apex]);
    }
  return least;
}

// The best handles within a limit, through all bases.
void search_within(ThreeSearch& x, f64 limit) {
  x.limit = limit, x.count = 0;
  for (u32 mirrored = 0; mirrored < 2; ++mirrored) {
    x.hand.view.mirrored = mirrored != 0;
    for (u32 apex = 0; apex < apex_count(x); ++apex) {
      f32& bound = x.s.bound[mirrored][apex];
      if (bound > most_bound(x) || is_done(x)) continue;
      open_base(x, mirrored != 0, apex);
      find_worth(x.s.tables);
      bound = max_of(bound, bound_base(x));
      if (bound <= most_bound(x)) search_base(x);
    }
  }
}

// The longest polygon leaves the fewest bases; an edge that has another polygon near leaves the fewest that are short.
ThreeView choose_view(const ThreeLoops& loops) {
  ThreeView view;
  for (u32 l = 1; l < 3; ++l)
    if (loops.sides(l) > loops.sides(view.loop)) view.loop = l;
  f64 least = no_way;
  const u32 first = loops.first[view.loop], n = loops.sides(view.loop);
  for (u32 e = 0; e < n; ++e)
    for (u32 w = 0; w < loops.first[3]; ++w) {
      if (w >= first && w < first + n) continue;
      const Vec3 &a = loops.points[first + e], &b = loops.points[first + (e + 1) % n];
      const f64 sum = length(loops.points[w] - a) + length(loops.points[w] - b);
      if (sum < least) least = sum, view.edge = e;
    }
  return view;
}

}  // namespace

u64 three_scratch_bytes(u32 longest, u32 vertices) {
  ThreeScratch s;
  return carve(s, nullptr, three_tables_bytes(longest, vertices), longest, vertices);
}

u32 shortest_of_three(const ThreeLoops& loops, f64 limit, u64 work, u8* scratch, Span<ThreeHandle> best,
                      bool& complete) {
  ThreeScratch s;
  const u32 longest = max_of(loops.sides(0), max_of(loops.sides(1), loops.sides(2)));
  carve(s, scratch, lay_out_three(loops, scratch, s.tables), longest, loops.first[3]);
  ask_for_faces(loops, s.tables);
  for (u32& face : s.inner->face) face = none;
  ThreeSearch x{loops, s, best, limit};
  x.most_work = work, x.hand.view = choose_view(loops);
  if (s.tables.filtered) x.work += u64{s.tables.vertices} * s.tables.vertices * work_of_a_question / 2;
  const u32 bases = loops.first[3] - loops.sides(x.hand.view.loop);
  complete = false;
  // Not even the bounds would be done.
  if (2 * bases * work_of_a_round(loops.sides(0), loops.sides(1), loops.sides(2)) > work) return 0;
  const f32 straight = bound_bases(x, false), least = min_of(straight, bound_bases(x, true));
  // A low margin costs little, and a high one much more than it need.
  constexpr f64 first_margin = 1.0 / 512, last_margin = 8;
  for (f64 margin = first_margin; !is_done(x); margin *= 2) {
    const f64 most = margin > last_margin ? limit : min_of(limit, static_cast<f64>(least) * (1 + margin));
    search_within(x, most);
    if (x.count == best.size || most == limit) break;
  }
  complete = !is_done(x);
  return x.count;
}

}  // namespace tpa
