// heap: ears of polygons in the order of their weight, ties by vertex. An ear whose polygon has changed since is
// recognised by its stamp, and skipped by whoever takes it out.
#pragma once

#include "base/fp.h"

namespace tpa {

struct Ear {
  f64 weight;
  u32 vertex, stamp;
};

inline bool comes_before(const Ear& a, const Ear& b) {
  return a.weight < b.weight || (a.weight == b.weight && a.vertex < b.vertex);
}

inline void push_ear(Stack<Ear>& heap, const Ear& ear) {
  if (!heap.push(ear)) return;
  u32 at = heap.size - 1;
  while (at > 0 && comes_before(heap[at], heap[(at - 1) / 2])) {
    swap_values(heap[at], heap[(at - 1) / 2]);
    at = (at - 1) / 2;
  }
}

inline Ear pop_ear(Stack<Ear>& heap) {
  const Ear first = heap[0];
  heap[0] = heap[heap.size - 1];
  --heap.size;
  for (u32 at = 0;;) {
    u32 least = at;
    for (u32 child = 2 * at + 1; child <= 2 * at + 2; ++child)
      if (child < heap.size && comes_before(heap[child], heap[least])) least = child;
    if (least == at) return first;
    swap_values(heap[at], heap[least]);
    at = least;
  }
}

}  // namespace tpa
