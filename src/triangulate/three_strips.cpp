// three_strips: the handle in hand, and the ways through its strips, depth first.
#include "triangulate/three_strips.h"

namespace tpa {

namespace {

constexpr u32 place_on(const ThreeTrack& t, u32 left) {
  if (t.round == 0) return t.forwards ? t.at + left : t.at - left;
  return t.forwards ? (t.at + left) % t.round : (t.at + t.round - left) % t.round;
}
constexpr u32 vertex_on(const ThreeTrack& t, u32 left) { return t.vertex[place_on(t, left)]; }
// The edge between the places for `left` and for one less.
constexpr u32 edge_on(const ThreeTrack& t, u32 left) { return t.edge[place_on(t, t.forwards ? left - 1 : left)]; }

f64 to_go(const ThreePiece& s, u32 x, u32 y) {
  return s.least[static_cast<i32>(x) * s.row + static_cast<i32>(y) * s.column];
}

constexpr u16 nowhere = 0xFFFF, apart = 0xFFFE;

// ---------------------------------------------------------------- the handle in hand

void set_pieces(const ThreeTables& t, const ThreeHandle& h, ThreePiece (&piece)[three_pieces]) {
  const u32 w = u32{h.from_b} - h.to_b, u = u32{h.from_a} - h.to_a, k = h.steps_c;
  piece[0] = {};
  piece[0].x = {t.a, t.edge_a, 0, true, 0}, piece[0].y = {t.b, t.edge_b, 0, true, 0};
  piece[0].steps_x = h.to_a, piece[0].steps_y = h.to_b, piece[0].split_y = h.to_b == t.q;
  piece[1] = {};
  piece[1].x = {t.a, t.edge_a, t.p - 1, false, 0}, piece[1].y = {t.b, t.edge_b, t.q, false, 0};
  piece[1].steps_x = t.p - 1 - h.from_a, piece[1].steps_y = t.q - h.from_b, piece[1].split_y = h.from_b == 0;
  piece[2] = {};
  piece[2].x = {t.a, t.edge_a, h.from_a, false, 0}, piece[2].y = {t.c, t.edge_c, h.from_c, true, t.r};
  piece[2].steps_x = u, piece[2].steps_y = k, piece[2].split_y = k == t.r;
  piece[3] = {};
  piece[3].x = {t.b, t.edge_b, h.from_b, false, 0}, piece[3].y = {t.c, t.edge_c, h.from_c, false, t.r};
  piece[3].steps_x = w, piece[3].steps_y = t.r - k, piece[3].split_x = w == t.q, piece[3].split_y = k == 0;
}
// Returns the least total of all strips.
f64 set_totals(ThreeSearch& x) {
  const ThreeTables& t = x.s.tables;
  const i32 r = static_cast<i32>(t.r + 1);
  x.piece[0].least = t.after, x.piece[0].row = static_cast<i32>(t.wide_q), x.piece[0].column = 1;
  x.piece[1].least = t.before + t.q * t.wide_p + (t.p - 1);
  x.piece[1].row = -1, x.piece[1].column = -static_cast<i32>(t.wide_p);
  x.piece[2].least = x.s.strip_a, x.piece[3].least = x.s.strip_b;
  x.piece[2].row = x.piece[3].row = r, x.piece[2].column = x.piece[3].column = 1;
  f64 rest = 0;
  for (u32 n = three_pieces; n-- > 0;) {
    const ThreePiece& s = x.piece[n];
    x.rest[n] = rest;
    rest += to_go(s, s.steps_x, s.steps_y);
  }
  return rest;
}

bool is_step_on_x(const ThreeHandle& h, u32 step) { return (h.word[step / 32] >> (step % 32)) & 1; }

f64 measure(const ThreeLoops& loops, const ThreeHandle& h, const ThreePiece (&piece)[three_pieces]) {
  f64 sum = 0;
  u32 step = 0;
  for (const ThreePiece& s : piece)
    for (u32 x = s.steps_x, y = s.steps_y;; is_step_on_x(h, step++) ? --x : --y) {
      sum += length(loops.points[vertex_on(s.x, x)] - loops.points[vertex_on(s.y, y)]);
      if (x + y == 0) break;
    }
  return sum;
}

// Of two handles that were found in the same view. Bits of steps that are none do not count.
bool is_same(const ThreeHandle& g, const ThreeHandle& h, u32 steps) {
  if (g.view.mirrored != h.view.mirrored || g.apex != h.apex || g.from_a != h.from_a || g.from_b != h.from_b ||
      g.from_c != h.from_c || g.to_a != h.to_a || g.to_b != h.to_b || g.steps_c != h.steps_c)
    return false;
  for (u32 step = 0; step < steps; ++step)
    if (is_step_on_x(g, step) != is_step_on_x(h, step)) return false;
  return true;
}

void enter_handle(ThreeSearch& x) {
  x.hand.length = measure(x.loops, x.hand, x.piece);
  if (x.hand.length > allowed(x)) return;
  const bool full = x.count == x.best.size;
  if (full && x.hand.length >= x.best[x.count - 1].length) return;
  for (u32 n = 0; n < x.count; ++n)
    if (x.best[n].length == x.hand.length && is_same(x.best[n], x.hand, x.s.tables.vertices - 1)) return;
  u32 at = full ? x.count - 1 : x.count++;
  for (; at > 0 && x.hand.length < x.best[at - 1].length; --at) x.best[at] = x.best[at - 1];
  x.best[at] = x.hand;
}

// ---------------------------------------------------------------- strips

void begin_piece(const ThreeSearch& x, u32 number, ThreeStep& step) {
  step.piece = static_cast<u8>(number);
  step.x = static_cast<u16>(x.piece[number].steps_x), step.y = static_cast<u16>(x.piece[number].steps_y);
  step.at_x = step.at_y = nowhere;
}

bool ends_well(const ThreeSearch& x, ThreeStep& step) {
  const ThreePiece& s = x.piece[step.piece];
  if ((s.split_x && step.at_x != apart) || (s.split_y && step.at_y != apart)) return false;
  if (step.piece < 2) step.flat = step.flat && (step.at_x == nowhere || step.at_x == 0);
  return step.piece != 1 || !step.flat || x.hand.from_a != x.hand.to_a;
}

f64 edge_in_hand(const ThreeSearch& x, const ThreePiece& s, u32 left_x, u32 left_y) {
  return length(x.loops.points[vertex_on(s.x, left_x)] - x.loops.points[vertex_on(s.y, left_y)]);
}

// Goes on with the next piece where one has come to its end. False where the handle has been entered, or is none.
bool settle(ThreeSearch& x, ThreeStep& step) {
  while (step.x + step.y == 0) {
    if (!ends_well(x, step)) return false;
    step.spent += edge_in_hand(x, x.piece[step.piece], 0, 0);
    if (step.piece + 1u == three_pieces) {
      if (step.spent > x.least_entered && step.spent <= x.most_followed) enter_handle(x);
      return false;
    }
    begin_piece(x, step.piece + 1u, step);
  }
  return true;
}

// Options 0 and 1: the step that is read is on x or on y, first on the one with the shorter way to go, so that the best
// handles are found first.
bool extend(ThreeSearch& x, const ThreeStep& from, u32 number, ThreeStep& child) {
  const ThreePiece& s = x.piece[from.piece];
  const bool x_first = from.y == 0 || (from.x > 0 && to_go(s, from.x - 1u, from.y) <= to_go(s, from.x, from.y - 1u));
  const bool on_x = (from.option == 0) == x_first;
  if ((on_x ? from.x : from.y) == 0) return false;
  const u32 edge = on_x ? edge_on(s.x, from.x) : edge_on(s.y, from.y);
  if (is_blocked(x.s.tables, edge, on_x ? vertex_on(s.y, from.y) : vertex_on(s.x, from.x))) return false;
  child = from, child.option = 0;
  --(on_x ? child.x : child.y);
  u16& at = on_x ? child.at_x : child.at_y;
  const u16 here = on_x ? from.y : from.x;
  at = at == nowhere || at == here ? here : apart;
  child.spent += edge_in_hand(x, s, from.x, from.y);
  u32& word = x.hand.word[number / 32];
  const u32 bit = 1u << (number % 32);
  word = on_x ? word | bit : word & ~bit;
  const f64 bound = child.spent + (to_go(s, child.x, child.y) + x.rest[child.piece]);
  return bound < too_long(x) && bound <= x.most_followed * (1 + three_rounding) && settle(x, child);
}

// Follows every way through the strips within the bounds.
void follow_strips(ThreeSearch& x) {
  ThreeStep* steps = x.s.step;
  steps[0] = {};
  begin_piece(x, 0, steps[0]);
  if (!settle(x, steps[0])) return;
  for (u32 depth = 0;;) {
    ThreeStep& top = steps[depth];
    if (top.option == 2) {
      if (depth-- == 0) return;
      continue;
    }
    const bool extended = extend(x, top, depth, steps[depth + 1]);
    ++top.option;
    if (++x.work >= x.most_work) return;
    if (extended) ++depth;
  }
}

}  // namespace

// All handles with these triangles that can still be among the best: first those a little longer than the shortest one,
// then those up to twice as much longer and so on, lest many be followed before some good ones are known.
void search_strips(ThreeSearch& x) {
  set_pieces(x.s.tables, x.hand, x.piece);
  const f64 least = set_totals(x);
  constexpr f64 first_margin = 0x1p-18, last_margin = 64;
  x.least_entered = -1;
  if (least >= too_long(x)) return;
  for (f64 margin = first_margin; x.least_entered < too_long(x) && !is_done(x); margin *= 2) {
    x.most_followed = margin > last_margin ? no_way : least * (1 + margin);
    follow_strips(x);
    x.least_entered = x.most_followed;
  }
}

void write_three(const ThreeLoops& loops, const ThreeHandle& h, u8* scratch, HandleFace* out) {
  ThreeTables t;
  lay_out_three(loops, scratch, t);
  set_places(loops, h.view, h.apex, t);
  const auto put_edge = [&loops, &out](u32 edge, u32 apex) {
    u32 l = 0;
    while (edge >= loops.first[l + 1]) ++l;
    *out++ = {{edge, edge + 1 == loops.first[l + 1] ? loops.first[l] : edge + 1, apex}};
  };
  const auto put_inner = [&h, &out](u32 a, u32 b, u32 c) {
    *out++ = h.view.mirrored ? HandleFace{{a, c, b}} : HandleFace{{a, b, c}};
  };
  put_edge(t.edge_a[t.p - 1], t.b[0]);
  put_inner(t.a[h.from_a], t.b[h.from_b], t.c[h.from_c]);
  put_inner(t.a[h.to_a], t.c[(h.from_c + h.steps_c) % t.r], t.b[h.to_b]);
  ThreePiece piece[three_pieces];
  set_pieces(t, h, piece);
  u32 step = 0;
  for (const ThreePiece& s : piece)
    for (u32 x = s.steps_x, y = s.steps_y; x + y > 0;)
      if (is_step_on_x(h, step++))
        put_edge(edge_on(s.x, x), vertex_on(s.y, y)), --x;
      else
        put_edge(edge_on(s.y, y), vertex_on(s.x, x)), --y;
}

}  // namespace tpa
