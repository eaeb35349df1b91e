// SPDX-License-Identifier: MIT
// heap: a binary heap (Williams 1964) of entries with weights, the least first, ties by number. An entry is not removed
// when its subject changes: with a stamp as tag the caller recognises stale entries, and skips them.
#pragma once

#include "base/base.h"

namespace tpa {

struct HeapEntry {
  f64 weight;
  u32 number, tag;  // of the caller; the tag plays no part in the order
};

inline bool comes_before(const HeapEntry& a, const HeapEntry& b) {
  return a.weight < b.weight || (a.weight == b.weight && a.number < b.number);
}

// Enters an entry, or drops it where the stack is full. O(log n).
inline void push_entry(Stack<HeapEntry>& heap, const HeapEntry& entry) {
  if (!heap.push(entry)) return;
  u32 at = heap.size - 1;
  while (at > 0 && comes_before(heap[at], heap[(at - 1) / 2])) {
    swap_values(heap[at], heap[(at - 1) / 2]);
    at = (at - 1) / 2;
  }
}

// Removes and returns the least entry. Pre: the heap is not empty. O(log n).
inline HeapEntry pop_least(Stack<HeapEntry>& heap) {
  const HeapEntry first = heap[0];
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
