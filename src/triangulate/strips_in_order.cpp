// SPDX-License-Identifier: MIT
// strips_in_order: closed strips in order of length, depth first, with the least lengths to go.
#include "triangulate/strips_in_order.h"

#include "base/arena.h"

namespace tpa {

namespace {

constexpr u16 no_column = 0xFFFF, bent = 0xFFFE;
constexpr f64 rounding = strip_rounding;

// y_start minus j, round the loop. Pre: j <= q.
u32 y_at(u32 start, u32 j, u32 q) { return start >= j ? start - j : start + q - j; }
bool holds(const u32* bits, u32 at) { return (bits[at / 32] >> (at % 32)) & 1; }

struct StripSearch {
  const StripLoops& loops;
  const FaceFilter& filter;
  StripOrder& s;
  u32 p, q, start = 0;
  f64 least_entered = 0, most_followed = 0;  // lengths of the strips whose turn it is
};
f64& to_go(const StripSearch& x, u32 i, u32 j) { return x.s.to_go[i + j * (x.p + 1)]; }
u32* words_of(const StripOrder& s, u32 number) { return s.words + number * s.per_strip; }

// Strips of this length or more need not be followed. Less than no_way.
f64 too_long(const StripSearch& x) {
  const StripOrder& s = x.s;
  return s.best.is_full() ? s.best.at[s.best.count - 1].length * (1 - rounding) : 0.5 * no_way;
}

// May the step from (i, j) be taken?
bool x_is_free(const StripSearch& x, u32 i, u32 j) {
  return i < x.p && holds(x.s.x_free, i * x.q + y_at(x.start, j, x.q));
}
bool y_is_free(const StripSearch& x, u32 i, u32 j) {
  return i < x.p && j < x.q && holds(x.s.y_free, i * x.q + y_at(x.start, j, x.q));
}

// Fills the least lengths to go, without the edge at (i, j), backwards from (p, q), which only a step on x may reach.
// The table is a lower bound: it does not forbid all steps on y in one column.
void fill_to_go(const StripSearch& x) {
  spend(x.s.meter, 1 + u64{x.p} * x.q / 4);
  f64* after_x = x.s.column;  // by j: the least length of a step on x to (i + 1, j) and beyond
  for (u32 i = x.p + 1; i-- > 0;) {
    f64 after_y = no_way;
    const bool last = i == x.p;
    for (u32 j = x.q + 1; j-- > 0;) {
      const u32 y = y_at(x.start, j, x.q), at = i * x.q + y;
      f64 least = last && j == x.q ? 0 : no_way;
      if (!last && holds(x.s.x_free, at)) least = min_of(least, after_x[j]);
      if (!last && j < x.q && holds(x.s.y_free, at)) least = min_of(least, after_y);
      to_go(x, i, j) = least;
      after_y = min_of(no_way, edge_length(x.loops, last ? 0 : i, y) + least);
      after_x[j] = after_y;
    }
  }
}

void set(u32* bits, u32 at, bool value) {
  const u32 bit = 1u << (at % 32);
  bits[at / 32] = value ? bits[at / 32] | bit : bits[at / 32] & ~bit;
}

// Asks about the face of a step from (i, j), unless that is known. True if the face turns out not to be free.
bool turns_out_taken(const StripSearch& x, u32 i, u32 j, bool on_x) {
  const StripLoops& loops = x.loops;
  const u32 y = y_at(x.start, j, x.q), at = i * x.q + y;
  u32* asked = on_x ? x.s.x_asked : x.s.y_asked;
  if (holds(asked, at)) return false;
  set(asked, at, true);
  const bool free = on_x ? is_free(x.filter, loops.x[i], loops.x[i + 1 == x.p ? 0 : i + 1], loops.y[y])
                         : is_free(x.filter, loops.y[y == 0 ? x.q - 1 : y - 1], loops.y[y], loops.x[i]);
  if (!free) set(on_x ? x.s.x_free : x.s.y_free, at, false);
  return !free;
}

// Asks about the faces of all strips from this start up to `limit` that can be free by the answers so far, column by
// column, with the least lengths spent on the way to it. True if any face turns out not to be free.
bool ask_within(const StripSearch& x, f64 limit) {
  f64* spent = x.s.column;
  bool any = false;
  for (u32 j = 0; j <= x.q; ++j) spent[j] = no_way;
  spent[0] = 0;
  for (u32 i = 0; i < x.p; ++i) {
    for (u32 j = 0; j <= x.q; ++j) {
      const f64 here = spent[j];
      spent[j] = no_way;  // of the next column from now on
      if (here + to_go(x, i, j) > limit) continue;
      const auto step = [&](u32 i_to, u32 j_to, bool on_x) {
        const f64 there = here + edge_length(x.loops, i_to == x.p ? 0 : i_to, y_at(x.start, j_to, x.q));
        if (there + to_go(x, i_to, j_to) > limit) return;
        if (turns_out_taken(x, i, j, on_x)) {
          any = true;
          return;
        }
        spent[j_to] = min_of(spent[j_to], there);
      };
      if (y_is_free(x, i, j)) step(i, j + 1, false);
      if (x_is_free(x, i, j)) step(i + 1, j, true);
    }
  }
  return any;
}

// Asks until the least lengths to go are lengths along free faces, wherever a strip up to `limit` can pass.
void ask_for_faces(const StripSearch& x, f64 limit) {
  if (x.filter.ask == nullptr) return;
  while (!has_stopped(x.s.meter) && ask_within(x, limit)) fill_to_go(x);
}

void enter_strip(StripSearch& x, f64 length) {
  StripOrder& s = x.s;
  if (length <= x.least_entered || length > x.most_followed || length >= too_long(x)) return;
  const u32 word = s.best.is_full() ? s.best.at[s.best.count - 1].word : s.best.count;
  s.best.enter({length, x.start, word});
  const u32* hand = words_of(s, s.best.at.size);
  for (u32 w = 0; w < s.per_strip; ++w) words_of(s, word)[w] = hand[w];
}

// Options 0 and 1 are a step on x and on y. The step with the shorter way to go comes first, so that the best strips
// are found early.
bool extend(StripSearch& x, const StripStep& from, StripStep& child) {
  const bool can_x = x_is_free(x, from.i, from.j), can_y = y_is_free(x, from.i, from.j);
  const bool x_first = !can_y || (can_x && to_go(x, from.i + 1u, from.j) <= to_go(x, from.i, from.j + 1u));
  const bool on_x = (from.option == 0) == x_first;
  if (!(on_x ? can_x : can_y)) return false;
  child = from, child.option = 0;
  if (on_x) {
    ++child.i;
  } else {
    ++child.j;
    child.column = from.column == no_column || from.column == from.i ? from.i : bent;
    if (child.j == x.q && child.column != bent) return false;
  }
  const u32 number = u32{from.i} + from.j, bit = 1u << (number % 32);
  u32& word = words_of(x.s, x.s.best.at.size)[number / 32];
  word = on_x ? word | bit : word & ~bit;
  child.spent += edge_length(x.loops, child.i == x.p ? 0 : child.i, y_at(x.start, child.j, x.q));
  const f64 bound = child.spent + to_go(x, child.i, child.j);
  if (bound >= too_long(x) || bound > x.most_followed * (1 + rounding)) return false;
  if (child.i < x.p) return true;
  enter_strip(x, child.spent);
  return false;
}

void follow_strips(StripSearch& x) {
  StripStep* steps = x.s.step;
  steps[0] = {};
  steps[0].column = no_column;
  u32 followed = 0;
  for (u32 depth = 0;; ++followed) {
    if (followed % 64 == 63) spend(x.s.meter, 64);
    if (has_stopped(x.s.meter)) return;
    StripStep& top = steps[depth];
    if (top.option == 2) {
      if (depth-- == 0) break;
      continue;
    }
    const bool extended = extend(x, top, steps[depth + 1]);
    ++top.option;
    if (extended) ++depth;
  }
  spend(x.s.meter, followed % 64);
}

// Bounds and measures use the room of the table before it is filled.
constexpr u64 places_to_go(u64 p, u64 q) { return (p + 1) * (q + 1) + q; }

// Measures the shortest strip from a start, and from the start beside it, which costs little more.
void measure_start(StripSearch& x, u32 start) {
  spend(x.s.meter, strip_work(x.p, x.q));
  const u32 first = start - start % 2, end = min_of(first + 2, x.q);
  f64 lengths[2];
  shortest_strip_lengths(x.loops, first, end, {x.s.to_go, static_cast<u32>(places_to_go(x.p, x.q))}, lengths);
  for (u32 s = first; s < end; ++s) {
    if (x.s.measured[s] == 0) x.s.start_length[s] = lengths[s - first];
    x.s.measured[s] = 1;
  }
}

// Finds all strips from a start that can still be among the best: first strips a little longer than the shortest, then
// up to twice as much longer and so on. Otherwise many would be followed before some good ones are known.
void search_start(StripSearch& x, u32 start) {
  x.start = start;
  fill_to_go(x);
  const f64 least = x.s.start_length[start];
  constexpr f64 last_margin = 64;
  x.least_entered = -1;
  for (f64 margin = 0x1p-16; x.least_entered < too_long(x) && !has_stopped(x.s.meter); margin *= 2) {
    x.most_followed = margin > last_margin ? no_way : least * (1 + margin);
    ask_for_faces(x, min_of(x.most_followed * (1 + 2 * rounding), 0.5 * no_way));
    follow_strips(x);
    x.least_entered = x.most_followed;
  }
}

}  // namespace

bool lay_out_strip_order(u32 p, u32 q, u32 wanted, u8* scratch, u64 scratch_bytes, StripOrder& s) {
  s = {};
  Carver carver{scratch, element_alignment};
  carver.take(s.start_length, q), carver.take(s.column, u64{q} + 1), carver.take(s.measured, q);
  carver.take(s.to_go, places_to_go(p, q));
  carver.take(s.step, u64{p} + q + 2);
  const u64 words = (u64{p} * q + 31) / 32;
  carver.take(s.x_free, words), carver.take(s.y_free, words);
  carver.take(s.x_asked, words), carver.take(s.y_asked, words);
  s.per_strip = (p + q + 31) / 32;
  const u64 each = sizeof(OrderedStrip) + s.per_strip * sizeof(u32), in_hand = s.per_strip * sizeof(u32) + 8;
  if (carver.bytes + in_hand + each > scratch_bytes) return false;
  s.best.at.size = static_cast<u32>(min_of<u64>(wanted, (scratch_bytes - carver.bytes - in_hand) / each));
  carver.take(s.best.at.data, s.best.at.size);
  carver.take(s.words, (u64{s.best.at.size} + 1) * s.per_strip);
  return true;
}

void find_strips(const StripLoops& loops, const FaceFilter& filter, StripOrder& s) {
  constexpr f64 done = -1;
  const u32 q = loops.y.size;
  StripSearch x{loops, filter, s, loops.x.size, q};
  s.best.count = 0;
  for (u32 word = 0; word < (x.p * q + 31) / 32; ++word) {
    s.x_free[word] = s.y_free[word] = none;
    s.x_asked[word] = s.y_asked[word] = 0;
  }
  for (u32 start = 0; start < q; ++start) s.measured[start] = 0;
  spend(s.meter, 2 * strip_work(x.p, q));
  bound_strip_lengths(loops, s.to_go, s.start_length);
  for (;;) {
    u32 best = none;
    for (u32 start = 0; start < q; ++start)
      if (s.start_length[start] != done && (best == none || s.start_length[start] < s.start_length[best])) best = start;
    spend(s.meter, q / 8);
    if (best == none || s.start_length[best] >= too_long(x) || has_stopped(s.meter)) return;
    if (s.measured[best] == 0) {
      measure_start(x, best);
    } else {
      search_start(x, best);
      s.start_length[best] = done;
    }
  }
}

void write_strip(const StripLoops& loops, const StripOrder& s, u32 number, FaceCorners* out) {
  const u32 p = loops.x.size, q = loops.y.size;
  const OrderedStrip& strip = s.best.at[number];
  for (u32 t = 0, i = 0, j = 0; t < p + q; ++t) {
    const u32 a = loops.x[i % p], b = loops.y[y_at(strip.start, j, q)];
    if (holds(words_of(s, strip.word), t))
      out[t] = {{a, loops.x[++i % p], b}};
    else
      out[t] = {{loops.y[y_at(strip.start, ++j, q)], b, a}};
  }
}

}  // namespace tpa
