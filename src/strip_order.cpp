// strip_order: closed strips in order of length, by best-first search with exact lengths to go.
#include "strip_order.h"

namespace tpa {

namespace {

// Longer beginnings first among equals, so that ties are followed to their end one at a time.
bool before(const StripBeginning& a, const StripBeginning& b) {
  if (a.total != b.total) return a.total < b.total;
  const u32 done_a = u32{a.i} + a.j, done_b = u32{b.i} + b.j;
  if (done_a != done_b) return done_a > done_b;
  return a.start != b.start ? a.start < b.start : a.word < b.word;
}

// A full heap loses the newcomer: only after thousands of ties can that leave a strip out.
void push(StripOrderScratch& scratch, const StripBeginning& beginning) {
  if (beginning.total >= no_way || scratch.count == StripOrderScratch::capacity) return;
  u32 at = scratch.count++;
  scratch.heap[at] = beginning;
  while (at > 0 && before(scratch.heap[at], scratch.heap[(at - 1) / 2])) {
    swap_values(scratch.heap[at], scratch.heap[(at - 1) / 2]);
    at = (at - 1) / 2;
  }
}

StripBeginning pop(StripOrderScratch& scratch) {
  const StripBeginning first = scratch.heap[0];
  scratch.heap[0] = scratch.heap[--scratch.count];
  for (u32 at = 0;;) {
    u32 least = at;
    for (u32 child = 2 * at + 1; child <= 2 * at + 2; ++child)
      if (child < scratch.count && before(scratch.heap[child], scratch.heap[least])) least = child;
    if (least == at) return first;
    swap_values(scratch.heap[at], scratch.heap[least]);
    at = least;
  }
}

u32 y_at(u32 start, u32 j, u32 q) { return (start + q - j % q) % q; }

// A face over the edge from x_i to the next one has apex y_j; one over the edge to y_j from the one before has apex x_i,
// for a step backwards from y_j.
void ask_for_faces(const StripLoops& loops, const FaceFilter& filter, StripOrderScratch& scratch) {
  const u32 p = loops.x.size, q = loops.y.size;
  for (u32 i = 0; i < p; ++i)
    for (u32 j = 0; j < q; ++j) {
      const u32 before_j = j == 0 ? q - 1 : j - 1;
      scratch.x_free[i][j] = is_free(filter, loops.x[i], loops.x[i + 1 == p ? 0 : i + 1], loops.y[j]);
      scratch.y_free[i][j] = is_free(filter, loops.y[before_j], loops.y[j], loops.x[i]);
    }
}

// Length to go, backwards from (p, q), which only a step on x may reach; no column takes all steps on y.
void fill_to_go(u32 start, u32 p, u32 q, StripOrderScratch& scratch) {
  const auto& d = scratch.distance;
  auto &bent = scratch.bent[start], &straight = scratch.straight[start];
  for (u32 j = 0; j <= q; ++j) bent[p][j] = straight[p][j] = j == q ? 0 : no_way;
  for (u32 i = p; i-- > 0;)
    for (u32 j = q + 1; j-- > 0;) {
      const u32 y = y_at(start, j, q), next_x = i + 1 == p ? 0 : i + 1;
      const f64 x_edge = scratch.x_free[i][y] ? d[next_x][y] : no_way, by_x = bent[i + 1][j] + x_edge;
      const f64 edge = j < q && scratch.y_free[i][y] ? d[i][y_at(start, j + 1, q)] : no_way;
      bent[i][j] = min_of(no_way, min_of(by_x, j < q ? bent[i][j + 1] + edge : no_way));
      // In row 0 a step on x leads to row 0 again, from where all steps on y may still come in one column.
      const f64 straight_by_x = j == 0 ? straight[i + 1][0] + x_edge : by_x;
      straight[i][j] = j == q ? no_way : min_of(no_way, min_of(straight_by_x, straight[i][j + 1] + edge));
    }
}

StripBeginning extended(const StripBeginning& from, bool x_step, u32 p, u32 q,
                        const StripOrderScratch& scratch) {
  StripBeginning to = from;
  const u32 y = y_at(from.start, from.j, q);
  if (!(x_step ? scratch.x_free : scratch.y_free)[from.i == p ? 0 : from.i][y]) {
    to.total = no_way;
    return to;
  }
  if (x_step) {
    to.word |= 1u << (from.i + from.j);
    ++to.i;
    to.straight = from.straight && from.j == 0;
  } else {
    ++to.j;
  }
  to.sofar += scratch.distance[to.i == p ? 0 : to.i][y_at(to.start, to.j, q)];
  const auto& to_go = to.straight ? scratch.straight : scratch.bent;
  to.total = to.sofar + to_go[to.start][to.i][to.j];
  return to;
}

void write_strip(const StripLoops& loops, const StripBeginning& strip, HandleFace* out) {
  const u32 p = loops.x.size, q = loops.y.size;
  for (u32 t = 0, i = 0, j = 0; t < p + q; ++t) {
    const u32 a = loops.x[i % p], b = loops.y[y_at(strip.start, j, q)];
    if ((strip.word >> t) & 1)
      out[t] = {{a, loops.x[++i % p], b}};
    else
      out[t] = {{loops.y[y_at(strip.start, ++j, q)], b, a}};
  }
}

}  // namespace

void begin_strip_order(const StripLoops& loops, const FaceFilter& filter, StripOrderScratch& scratch) {
  const u32 p = loops.x.size, q = loops.y.size;
  for (u32 i = 0; i < p; ++i)
    for (u32 j = 0; j < q; ++j)
      scratch.distance[i][j] = length(loops.points[loops.x[i]] - loops.points[loops.y[j]]);
  ask_for_faces(loops, filter, scratch);
  scratch.count = 0;
  for (u32 start = 0; start < q; ++start) {
    fill_to_go(start, p, q, scratch);
    StripBeginning beginning;
    beginning.start = static_cast<u8>(start), beginning.straight = true;
    beginning.total = scratch.straight[start][0][0];
    push(scratch, beginning);
  }
}

bool next_strip(const StripLoops& loops, StripOrderScratch& scratch, HandleFace* out) {
  const u32 p = loops.x.size, q = loops.y.size;
  while (scratch.count > 0) {
    const StripBeginning strip = pop(scratch);
    if (strip.i == p && strip.j == q) {
      write_strip(loops, strip, out);
      return true;
    }
    if (strip.i < p) push(scratch, extended(strip, true, p, q, scratch));
    if (strip.j < q) push(scratch, extended(strip, false, p, q, scratch));
  }
  return false;
}

}  // namespace tpa
