// SPDX-License-Identifier: MIT
// ear_clipping: ears in a heap.
#include "triangulate/ear_clipping.h"

#include "base/heap.h"

namespace tpa {

void clip_cap(const Vec3* points, u32 n, DiscWeight weight, u8* scratch, FaceCorners* out) {
  // A vertex enters the heap once, and again whenever a neighbour is clipped: at most 3 n times.
  Stack<HeapEntry> heap{reinterpret_cast<HeapEntry*>(scratch), 3 * n, 0};
  u32* previous = reinterpret_cast<u32*>(scratch + u64{3} * n * sizeof(HeapEntry));
  u32 *next = previous + n, *stamp = next + n;
  const auto consider = [&](u32 v) {
    const Vec3 &a = points[previous[v]], &b = points[next[v]];
    const f64 w = weight == DiscWeight::length ? length(b - a) : corner_cost(weight, a, points[v], b);
    push_entry(heap, {w, v, ++stamp[v]});
  };
  for (u32 v = 0; v < n; ++v) previous[v] = v == 0 ? n - 1 : v - 1, next[v] = v + 1 == n ? 0 : v + 1, stamp[v] = 0;
  for (u32 v = 0; v < n; ++v) consider(v);
  for (u32 count = 0; count < n - 2;) {
    const HeapEntry least = pop_least(heap);
    const u32 v = least.number;
    if (stamp[v] != least.tag) continue;
    const u32 a = previous[v], b = next[v];
    out[count++] = {{a, v, b}};
    stamp[v] = none;
    next[a] = b, previous[b] = a;
    consider(a);
    consider(b);
  }
}

}  // namespace tpa
