// SPDX-License-Identifier: MIT
// sort: sorting and bisection without allocation or recursion. Keys are never equal where their order matters, so every
// sort gives the same result on every platform.
#pragma once

#include "base/base.h"

namespace tpa {

// Heap sort (Williams 1964), O(n log n) in the worst case. A list in order, as the contacts of one island, takes O(n).
template <class T, class Less>
constexpr void sort_in_place(T* a, u32 n, Less less) {
  u32 in_order = 1;
  while (in_order < n && !less(a[in_order], a[in_order - 1])) ++in_order;
  if (in_order >= n) return;
  auto sift = [&](u32 root, u32 end) {
    for (;;) {
      u32 child = 2 * root + 1;
      if (child >= end) return;
      // No branch: the greater child is as good as random.
      child += static_cast<u32>(less(a[child], a[child + (child + 1 < end ? 1 : 0)]));
      if (!less(a[root], a[child])) return;
      swap_values(a[root], a[child]);
      root = child;
    }
  };
  for (u32 i = n / 2; i-- > 0;) sift(i, n);
  for (u32 end = n; end-- > 1;) {
    swap_values(a[0], a[end]);
    sift(0, end);
  }
}

// Units of work (base/meter.h) of a sort.
constexpr u64 sorting_steps(u64 n) {
  u64 log = 0;
  while (n >> log != 0) ++log;
  return n * log / 2;
}

template <class T>
constexpr void sort_in_place(T* a, u32 n) {
  sort_in_place(a, n, [](const T& x, const T& y) { return x < y; });
}

// The number of elements with is_before(a[i]); these come first in a[0 .. n - 1]. O(log n), no branch on the answers.
template <class T, class Before>
constexpr u32 count_before(const T* a, u32 n, Before is_before) {
  u32 at = 0;
  for (; n > 1; n -= n / 2) at += static_cast<u32>(is_before(a[at + n / 2 - 1])) * (n / 2);
  return at + static_cast<u32>(n == 1 && is_before(a[at]));
}

}  // namespace tpa
