#include "triangulate/three_bounds.h"

namespace tpa {

namespace {

constexpr u32 lanes = 4;  // rows are multiples of this long, so that compilers can take several places at once
constexpr u32 widened(u32 n) { return (n + lanes - 1) / lanes * lanes; }

// For any of three loops in any part.
u64 carve(ThreeTables& t, u8* base, u32 longest, u32 vertices) {
  Carver carver{base, three_alignment};
  const u64 n = longest + 1, wide = widened(longest + 1);
  carver.take(t.a, n), carver.take(t.b, n), carver.take(t.c, n);
  carver.take(t.edge_a, n), carver.take(t.edge_b, n), carver.take(t.edge_c, n);
  carver.take(t.ca, n * wide), carver.take(t.cb, n * wide);
  carver.take(t.after, n * wide), carver.take(t.before, n * wide);
  carver.take(t.reached, n * wide);
  carver.take(t.worth_a, wide), carver.take(t.worth_b, wide), carver.take(t.lent_a, wide), carver.take(t.lent_b, wide);
  for (u32 turn = 0; turn < 2; ++turn) carver.take(t.line_a[turn], wide), carver.take(t.line_b[turn], wide);
  carver.take(t.entry, wide);
  carver.take(t.blocked, (u64{vertices} * vertices + 31) / 32);
  return carver.bytes;
}

constexpr f64 no_strip = static_cast<f64>(far_away);

template <class T>
void fill_far(T* line, u32 n) {
  for (u32 i = 0; i < n; ++i) line[i] = far_away;
}

// to[x] = the least of from[y] + link[y][x].
void least_columns(const f32* from, const f64* link, u32 rows, u32 wide, f64* to) {
  for (u32 block = 0; block < wide; block += lanes) {
    f64 least[lanes];
    fill_far(least, lanes);
    for (u32 y = 0; y < rows; ++y) {
      const f64 start = static_cast<f64>(from[y]), *row = link + y * wide + block;
      for (u32 l = 0; l < lanes; ++l) least[l] = min_of(least[l], start + row[l]);
    }
    for (u32 l = 0; l < lanes; ++l) to[block + l] = least[l];
  }
}

// The least of link[x] + to[x].
f32 least_of_row(const f64* link, const f64* to, u32 wide) {
  f64 least[lanes];
  fill_far(least, lanes);
  for (u32 block = 0; block < wide; block += lanes)
    for (u32 l = 0; l < lanes; ++l) least[l] = min_of(least[l], link[block + l] + to[block + l]);
  f64 all = no_strip;
  for (u32 l = 0; l < lanes; ++l) all = min_of(all, least[l]);
  return static_cast<f32>(all);
}

f64 exact_distance(const ThreeLoops& loops, u32 v, u32 w) { return length(loops.points[v] - loops.points[w]); }
f32 distance(const ThreeLoops& loops, u32 v, u32 w) { return static_cast<f32>(exact_distance(loops, v, w)); }

// Vertex `at` of a loop as counted in the view, and the edge from there to the next one.
u32 seen_vertex(const ThreeLoops& loops, bool mirrored, u32 loop, u32 at) {
  const u32 n = loops.sides(loop), t = at % n;
  return loops.first[loop] + (mirrored ? n - 1 - t : t);
}
u32 seen_edge(const ThreeLoops& loops, bool mirrored, u32 loop, u32 at) {
  return seen_vertex(loops, mirrored, loop, mirrored ? at + 1 : at);
}
u32 loop_b(const ThreeView& v) { return (v.loop + (v.mirrored ? 2 : 1)) % 3; }
u32 loop_c(const ThreeView& v) { return (v.loop + (v.mirrored ? 1 : 2)) % 3; }

// Strips that begin at the base: forwards on A from its place 0, on B from its place 0.
void fill_after(const ThreeLoops& loops, ThreeTables& t) {
  for (u32 i = 0; i < t.p; ++i) {
    f64* row = t.after + i * t.wide_q;
    fill_far(row, t.wide_q);
    for (u32 j = 0; j <= t.q; ++j) {
      f64 least = i + j == 0 ? 0 : no_strip;
      if (i > 0 && !is_blocked(t, t.edge_a[i - 1], t.b[j])) least = (row - t.wide_q)[j];
      if (j > 0 && !is_blocked(t, t.edge_b[j - 1], t.a[i])) least = min_of(least, row[j - 1]);
      row[j] = min_of(no_strip, least + exact_distance(loops, t.a[i], t.b[j]));
    }
  }
}
// Strips that end there: the last places of both.
void fill_before(const ThreeLoops& loops, ThreeTables& t) {
  for (u32 j = t.q + 1; j-- > 0;) {
    f64* row = t.before + j * t.wide_p;
    fill_far(row, t.wide_p);
    for (u32 i = t.p; i-- > 0;) {
      f64 least = i + 1 == t.p && j == t.q ? 0 : no_strip;
      if (i + 1 < t.p && !is_blocked(t, t.edge_a[i], t.b[j])) least = row[i + 1];
      if (j < t.q && !is_blocked(t, t.edge_b[j], t.a[i])) least = min_of(least, row[i + t.wide_p]);
      row[i] = min_of(no_strip, least + exact_distance(loops, t.a[i], t.b[j]));
    }
  }
}

// ---------------------------------------------------------------- ways round C

// Steps along A and B on one place of C: forwards, from states that have been paid for.
void along_a(const ThreeTables& t, u32 c, f32* line) {
  for (u32 i = t.p - 1; i > 0; --i)
    if (!is_blocked(t, t.edge_a[i - 1], t.c[c]))
      line[i - 1] = min_of(line[i - 1], line[i] + t.ca[c * t.wide_p + i - 1]);
}
void along_b(const ThreeTables& t, u32 c, f32* line) {
  for (u32 j = 0; j < t.q; ++j)
    if (!is_blocked(t, t.edge_b[j], t.c[c])) line[j + 1] = min_of(line[j + 1], line[j] + t.cb[c * t.wide_q + j + 1]);
}
// Backwards, for states whose edge has not been paid for.
void back_along_a(const ThreeTables& t, u32 c, f32* line) {
  for (u32 i = 1; i < t.p; ++i)
    if (!is_blocked(t, t.edge_a[i - 1], t.c[c])) line[i] = min_of(line[i], t.ca[c * t.wide_p + i - 1] + line[i - 1]);
}
void back_along_b(const ThreeTables& t, u32 c, f32* line) {
  for (u32 j = t.q; j-- > 0;)
    if (!is_blocked(t, t.edge_b[j], t.c[c])) line[j] = min_of(line[j], t.cb[c * t.wide_q + j + 1] + line[j + 1]);
}

// A step on C to its next place; what leads nowhere is far away.
void step_on_c(const ThreeTables& t, u32 c, const u16* place, u32 n, const f32* length, f32* line) {
  for (u32 i = 0; i < n; ++i) line[i] = line[i] + length[i];
  if (!t.filtered) return;
  for (u32 i = 0; i < n; ++i)
    if (is_blocked(t, t.edge_c[c], place[i])) line[i] = far_away;
}

void add_entry(f32* line, const f64* entry, const f32* length, u32 n) {
  for (u32 i = 0; i < n; ++i) line[i] = min_of(line[i], min_of(far_away, static_cast<f32>(entry[i]) + length[i]));
}

// Into the next turn's line, by an inner triangle at place c of C.
void enter_b(ThreeTables& t, u32 c, const f32* from, f32* to) {
  least_columns(from, t.after, t.p, t.wide_q, t.entry);
  add_entry(to, t.entry, t.cb + c * t.wide_q, t.q + 1);
}
void enter_a(ThreeTables& t, u32 c, const f32* from, f32* to) {
  least_columns(from, t.before, t.q + 1, t.wide_p, t.entry);
  add_entry(to, t.entry, t.ca + c * t.wide_p, t.p);
}
// The other way: what it takes from places of A on, given that from places of B on.
void back_to_a(ThreeTables& t, u32 c, const f32* b, f32* a) {
  for (u32 j = 0; j < t.wide_q; ++j) t.entry[j] = static_cast<f64>(min_of(far_away, b[j] + t.cb[c * t.wide_q + j]));
  for (u32 i = 0; i < t.p; ++i) a[i] = min_of(a[i], least_of_row(t.after + i * t.wide_q, t.entry, t.wide_q));
}
void back_to_b(ThreeTables& t, u32 c, const f32* a, f32* b) {
  for (u32 i = 0; i < t.wide_p; ++i) t.entry[i] = static_cast<f64>(min_of(far_away, a[i] + t.ca[c * t.wide_p + i]));
  for (u32 j = 0; j <= t.q; ++j) b[j] = min_of(b[j], least_of_row(t.before + j * t.wide_p, t.entry, t.wide_p));
}

void clear_lines(ThreeTables& t) {
  for (u32 turn = 0; turn < 2; ++turn) fill_far(t.line_a[turn], t.wide_p), fill_far(t.line_b[turn], t.wide_q);
}

// From place c of C, whose lines are done, to the one before it.
void back_on_c(ThreeTables& t, u32 c, u32 turn) {
  step_on_c(t, c - 1, t.a, t.p, t.ca + c * t.wide_p, t.line_a[turn]);
  step_on_c(t, c - 1, t.b, t.q + 1, t.cb + c * t.wide_q, t.line_b[turn]);
}
void block_last_step(ThreeTables& t, u32 turn) {
  for (u32 i = 0; i < t.p; ++i)
    if (is_blocked(t, t.edge_c[t.r - 1], t.a[i])) t.line_a[turn][i] = far_away;
  for (u32 j = 0; j <= t.q; ++j)
    if (is_blocked(t, t.edge_c[t.r - 1], t.b[j])) t.line_b[turn][j] = far_away;
}

// Places that the end cannot be reached from get the worth of the dearest that it can: any worth will do.
void settle_worth(const f32* way, f32* worth, u32 n, f32 dearest) {
  for (u32 i = 0; i < n; ++i) worth[i] = way[i] < 0.5f * far_away ? way[i] : dearest;
}

constexpr bool holds(const ThreePart& part, u32 place) { return place >= part.begin && place < part.end; }
constexpr u32 order_on_a(const ThreeTables& t, u32 i) { return t.p - 1 - i; }
constexpr u32 order_on_b(const ThreeTables& t, u32 j) { return t.p + j; }

void begin_ways(const ThreePart& part, ThreeTables& t) {
  clear_lines(t);
  for (u32 i = 0; i < t.p; ++i)
    if (holds(part, order_on_a(t, i))) t.line_a[0][i] = t.ca[i] - t.worth_a[i];
  for (u32 j = 0; j <= t.q; ++j)
    if (holds(part, order_on_b(t, j))) t.line_b[0][j] = t.cb[j] - t.worth_b[j];
}

}  // namespace

u64 three_tables_bytes(u32 longest, u32 vertices) {
  ThreeTables t;
  return carve(t, nullptr, longest, vertices);
}

u64 lay_out_three(const ThreeLoops& loops, u8* room, ThreeTables& t) {
  t.vertices = loops.first[3];
  return carve(t, room, max_of(loops.sides(0), max_of(loops.sides(1), loops.sides(2))), t.vertices);
}

void ask_for_faces(const ThreeLoops& loops, ThreeTables& t) {
  t.filtered = loops.filter.ask != nullptr;
  if (!t.filtered) return;
  for (u32 word = 0; word < (t.vertices * t.vertices + 31) / 32; ++word) t.blocked[word] = 0;
  for (u32 l = 0; l < 3; ++l)
    for (u32 v = loops.first[l]; v < loops.first[l + 1]; ++v) {
      const u32 next = v + 1 == loops.first[l + 1] ? loops.first[l] : v + 1;
      for (u32 w = 0; w < t.vertices; ++w) {
        if ((w >= loops.first[l] && w < loops.first[l + 1]) || is_free(loops.filter, v, next, w)) continue;
        const u32 bit = v * t.vertices + w;
        t.blocked[bit / 32] |= 1u << (bit % 32);
      }
    }
}

void set_places(const ThreeLoops& loops, const ThreeView& view, u32 apex, ThreeTables& t) {
  const u32 la = view.loop, lb = loop_b(view), lc = loop_c(view);
  const bool mirrored = view.mirrored;
  t.p = loops.sides(la), t.q = loops.sides(lb), t.r = loops.sides(lc);
  t.wide_p = widened(t.p), t.wide_q = widened(t.q + 1);
  const u32 start = mirrored ? t.p - 1 - view.edge : view.edge + 1;
  for (u32 i = 0; i < t.p; ++i) {
    t.a[i] = static_cast<u16>(seen_vertex(loops, mirrored, la, start + i));
    t.edge_a[i] = static_cast<u16>(seen_edge(loops, mirrored, la, start + i));
  }
  for (u32 j = 0; j <= t.q; ++j) {
    t.b[j] = static_cast<u16>(seen_vertex(loops, mirrored, lb, apex + t.q - j));
    t.edge_b[j] = static_cast<u16>(seen_edge(loops, mirrored, lb, apex + 2 * t.q - j - 1));
  }
  for (u32 c = 0; c < t.r; ++c) {
    t.c[c] = static_cast<u16>(seen_vertex(loops, mirrored, lc, c));
    t.edge_c[c] = static_cast<u16>(seen_edge(loops, mirrored, lc, c));
  }
}

void measure_base(const ThreeLoops& loops, ThreeTables& t) {
  for (u32 c = 0; c < t.r; ++c) {
    fill_far(t.ca + c * t.wide_p, t.wide_p), fill_far(t.cb + c * t.wide_q, t.wide_q);
    for (u32 i = 0; i < t.p; ++i) t.ca[c * t.wide_p + i] = distance(loops, t.c[c], t.a[i]);
    for (u32 j = 0; j <= t.q; ++j) t.cb[c * t.wide_q + j] = distance(loops, t.c[c], t.b[j]);
  }
  fill_after(loops, t), fill_before(loops, t);
}

// The shortest way to the place of B nearest to where C is cut open.
void find_worth(ThreeTables& t) {
  u32 end = 0;
  for (u32 j = 1; j <= t.q; ++j)
    if (t.cb[j] < t.cb[end]) end = j;
  clear_lines(t);
  t.line_b[1][end] = 0;
  block_last_step(t, 1);
  for (u32 c = t.r; c-- > 0;) {
    back_along_b(t, c, t.line_b[1]);
    back_to_a(t, c, t.line_b[1], t.line_a[1]), back_along_a(t, c, t.line_a[1]);
    back_to_b(t, c, t.line_a[1], t.line_b[0]), back_along_b(t, c, t.line_b[0]);
    back_to_a(t, c, t.line_b[0], t.line_a[0]), back_along_a(t, c, t.line_a[0]);
    if (c > 0) back_on_c(t, c, 0), back_on_c(t, c, 1);
  }
  f32 dearest = 0;
  for (u32 i = 0; i < t.p; ++i)
    if (t.line_a[0][i] < 0.5f * far_away) dearest = max_of(dearest, t.line_a[0][i]);
  for (u32 j = 0; j <= t.q; ++j)
    if (t.line_b[0][j] < 0.5f * far_away) dearest = max_of(dearest, t.line_b[0][j]);
  settle_worth(t.line_a[0], t.worth_a, t.p, dearest), settle_worth(t.line_b[0], t.worth_b, t.q + 1, dearest);
}

void lend_worth(ThreeTables& t) {
  for (u32 i = 0; i < t.p; ++i) t.lent_a[i] = t.worth_a[i];
  for (u32 j = 0; j <= t.q; ++j) t.lent_b[j] = t.worth_b[j];
}

void borrow_worth(ThreeTables& t, i32 ahead) {
  const i32 q = static_cast<i32>(t.q);
  const f32 round = t.lent_b[t.q] - t.lent_b[0];
  for (u32 i = 0; i < t.p; ++i) t.worth_a[i] = t.lent_a[i];
  for (i32 j = 0; j <= q; ++j) {
    const i32 from = j + ahead;
    t.worth_b[j] = from < 0 ? t.lent_b[from + q] - round : from > q ? t.lent_b[from - q] + round : t.lent_b[from];
  }
}

f32 bound_part(const ThreePart& part, ThreeTables& t) {
  if (is_blocked(t, t.edge_a[t.p - 1], t.b[0])) return far_away;
  const bool on_a = begins_on_a(t, part), on_b = ends_on_b(t, part);
  begin_ways(part, t);
  for (u32 c = 0; c < t.r; ++c) {
    if (c > 0)
      for (u32 turn = 0; turn < 2; ++turn) {
        step_on_c(t, c - 1, t.a, t.p, t.ca + c * t.wide_p, t.line_a[turn]);
        step_on_c(t, c - 1, t.b, t.q + 1, t.cb + c * t.wide_q, t.line_b[turn]);
      }
    if (on_a) along_a(t, c, t.line_a[0]), enter_b(t, c, t.line_a[0], t.line_b[0]);
    along_b(t, c, t.line_b[0]);
    for (u32 j = 0; j < t.wide_q; ++j) t.reached[c * t.wide_q + j] = t.line_b[0][j];
    enter_a(t, c, t.line_b[0], t.line_a[1]), along_a(t, c, t.line_a[1]);
    if (on_b) enter_b(t, c, t.line_a[1], t.line_b[1]), along_b(t, c, t.line_b[1]);
  }
  block_last_step(t, 1);
  f32 least = far_away;
  for (u32 i = 0; i < t.p; ++i)
    if (holds(part, order_on_a(t, i))) least = min_of(least, t.line_a[1][i] + t.worth_a[i]);
  for (u32 j = 0; j <= t.q; ++j)
    if (holds(part, order_on_b(t, j))) least = min_of(least, t.line_b[1][j] + t.worth_b[j]);
  return least;
}

void step_back(const ThreePart& part, u32 c, ThreeTables& t) {
  if (c + 1 == t.r) {
    clear_lines(t);
    for (u32 i = 0; i < t.p; ++i)
      if (holds(part, order_on_a(t, i))) t.line_a[1][i] = t.worth_a[i];
    for (u32 j = 0; j <= t.q; ++j)
      if (holds(part, order_on_b(t, j))) t.line_b[1][j] = t.worth_b[j];
    block_last_step(t, 1);
  } else {
    back_on_c(t, c + 1, 1);
  }
  if (ends_on_b(t, part)) back_along_b(t, c, t.line_b[1]), back_to_a(t, c, t.line_b[1], t.line_a[1]);
  back_along_a(t, c, t.line_a[1]);
}

void fill_three_strip(const ThreeLoops& loops, const ThreeTables& t, const ThreeStrip& s, f64* line) {
  const u32 wide = t.r + 1;
  const bool all_x = s.at == s.all_x;
  fill_far(line, wide);  // a step on X has been taken and then one on C
  for (u32 u = 0; u <= s.at; ++u) {
    f64 *row = s.least + u * wide, *above = u > 0 ? row - wide : row;
    const bool last = all_x && u == s.at;
    f64 both_c = no_strip;  // a step on C has been taken and then one on X
    for (u32 k = 0; k <= t.r; ++k) {
      const u32 c = place_on_c(t, s, k);
      const f64 edge = exact_distance(loops, s.x[s.at - u], t.c[c]);
      const bool by_x = u > 0 && !is_blocked(t, s.edge_x[s.at - u], t.c[c]);
      const bool by_c = k > 0 && !is_blocked(t, t.edge_c[edge_on_c(t, s, k)], s.x[s.at - u]);
      const f64 x_line = by_x ? line[k] : no_strip, above_k = by_x ? above[k] : no_strip;
      const f64 left = by_c ? row[k - 1] : no_strip;
      const f64 start = u + k == 0 ? 0 : no_strip;
      if (k == t.r) {  // all steps on C: not in a row
        row[k] = last ? no_strip : min_of(no_strip, edge + min_of(above_k, by_c ? both_c : no_strip));
        continue;
      }
      if (u > 0) line[k] = min_of(no_strip, edge + min_of(x_line, by_c && !last ? row[k - 1] : no_strip));
      if (k > 0) both_c = min_of(no_strip, edge + min_of(by_c ? both_c : no_strip, above_k));
      row[k] = last ? min_of(no_strip, edge + min_of(left, x_line))
                    : min_of(no_strip, edge + min_of(start, min_of(left, above_k)));
    }
  }
}

}  // namespace tpa
