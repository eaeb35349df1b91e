// cap: ear clipping.
#include "cap.h"

namespace tpa {

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

void clip_cap(const Vec3* points, u32 n, DiscWeight weight, u8* scratch, HandleFace* out) {
  // A vertex enters the heap once, and again whenever a neighbour is clipped: at most 3 n times.
  Stack<Ear> heap{reinterpret_cast<Ear*>(scratch), 3 * n, 0};
  u32* previous = reinterpret_cast<u32*>(scratch + u64{3} * n * sizeof(Ear));
  u32 *next = previous + n, *stamp = next + n;
  const auto consider = [&](u32 v) {
    const Vec3 &a = points[previous[v]], &b = points[next[v]];
    const f64 w = weight == DiscWeight::length ? length(b - a) : corner_cost(weight, a, points[v], b);
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
