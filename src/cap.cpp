// cap: best caps by dynamic programming (Klincsek 1980, Barequet and Sharir 1995), and ear clipping.
#include "cap.h"

namespace tpa {

namespace {

constexpr f64 infinite = 1e300;

// How badly shaped the triangle is: the cosine of its largest angle, from -1 (flat) to 1/2, mapped to 0 .. 1.
f64 shape_cost(Vec3 a, Vec3 b, Vec3 c) {
  const f64 p = squared_length(b - c), q = squared_length(c - a), r = squared_length(a - b);
  const f64 longest = max_of(p, max_of(q, r));
  const f64 others = p + q + r - longest;
  const f64 product = p == longest ? q * r : q == longest ? p * r : p * q;
  if (product <= 0) return 4;
  const f64 cosine = (others - longest) / (2 * square_root(product));
  const f64 cost = (0.5 - cosine) / 1.5;
  return cost * cost;
}

// What a face adds, its chord from a to c counted with it. `c_is_edge`: the edge c -> a belongs to the loop.
f64 face_cost(CapWeight weight, Vec3 a, Vec3 b, Vec3 c, bool closing_edge) {
  if (weight == CapWeight::length) return closing_edge ? 0 : length(c - a);
  if (weight == CapWeight::area) return length(area_normal(a, b, c));
  return shape_cost(a, b, c);
}

}  // namespace

void best_cap(const Vec3* points, u32 n, CapWeight weight, u8* scratch, HandleFace* out) {
  f64* cost = reinterpret_cast<f64*>(scratch);
  u8* split = scratch + u64{n} * n * sizeof(f64);
  for (u32 i = 0; i + 1 < n; ++i) cost[i * n + i + 1] = 0;
  for (u32 span = 2; span < n; ++span)
    for (u32 i = 0; i + span < n; ++i) {
      const u32 j = i + span;
      const bool closing = span + 1 == n;
      f64 best = infinite;
      u32 best_k = i + 1;
      for (u32 k = i + 1; k < j; ++k) {
        const f64 inner = cost[i * n + k] + cost[k * n + j];
        const f64 total = inner + face_cost(weight, points[i], points[k], points[j], closing);
        if (total < best) best = total, best_k = k;
      }
      cost[i * n + j] = best;
      split[i * n + j] = static_cast<u8>(best_k);
    }
  struct Chord {
    u8 from, to;
  } stack[longest_best_cap];
  u32 depth = 0, count = 0;
  stack[depth++] = {0, static_cast<u8>(n - 1)};
  while (depth > 0) {
    const Chord c = stack[--depth];
    if (c.to - c.from < 2) continue;
    const u8 k = split[c.from * n + c.to];
    out[count++] = {{c.from, k, c.to}};
    stack[depth++] = {k, c.to};
    stack[depth++] = {c.from, k};
  }
}

namespace {

// A binary heap of ears by weight, ties by vertex; stale entries are recognised by their stamp and skipped.
struct Ear {
  f64 weight;
  u32 vertex, stamp;
};
bool before(const Ear& a, const Ear& b) {
  return a.weight < b.weight || (a.weight == b.weight && a.vertex < b.vertex);
}
void push_ear(Stack<Ear>& heap, const Ear& ear) {
  if (!heap.push(ear)) return;
  u32 at = heap.size - 1;
  while (at > 0 && before(heap[at], heap[(at - 1) / 2])) {
    swap_values(heap[at], heap[(at - 1) / 2]);
    at = (at - 1) / 2;
  }
}
Ear pop_ear(Stack<Ear>& heap) {
  const Ear first = heap[0];
  heap[0] = heap[heap.size - 1];
  --heap.size;
  for (u32 at = 0;;) {
    u32 least = at;
    for (u32 child = 2 * at + 1; child <= 2 * at + 2; ++child)
      if (child < heap.size && before(heap[child], heap[least])) least = child;
    if (least == at) return first;
    swap_values(heap[at], heap[least]);
    at = least;
  }
}

}  // namespace

void clip_cap(const Vec3* points, u32 n, CapWeight weight, u8* scratch, HandleFace* out) {
  // A vertex enters the heap once, and again whenever a neighbour is clipped: at most 3 n times.
  Stack<Ear> heap{reinterpret_cast<Ear*>(scratch), 3 * n, 0};
  u32* previous = reinterpret_cast<u32*>(scratch + u64{3} * n * sizeof(Ear));
  u32 *next = previous + n, *stamp = next + n;
  const auto consider = [&](u32 v) {
    const f64 w = face_cost(weight, points[previous[v]], points[v], points[next[v]], false);
    push_ear(heap, {w, v, ++stamp[v]});
  };
  for (u32 v = 0; v < n; ++v)
    previous[v] = v == 0 ? n - 1 : v - 1, next[v] = v + 1 == n ? 0 : v + 1, stamp[v] = 0;
  for (u32 v = 0; v < n; ++v) consider(v);
  for (u32 count = 0; count < n - 2;) {
    const Ear ear = pop_ear(heap);
    const u32 v = ear.vertex;
    if (stamp[v] != ear.stamp) continue;
    const u32 a = previous[v], b = next[v];
    out[count++] = {{a, v, b}};
    stamp[v] = none;
    next[a] = b, previous[b] = a;
    consider(a);
    consider(b);
  }
}

}  // namespace tpa
