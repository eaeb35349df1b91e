// SPDX-License-Identifier: MIT
// disjoint_sets: a partition of numbers as a forest. parent[i] is another number of the set of i, or i itself at the
// root, the name of the set. Searches halve their paths (Tarjan & van Leeuwen 1984). A joined set keeps the lower of
// both names, so names do not depend on the order of the joins.
#pragma once

#include "base/base.h"

namespace tpa {

// The name of the set of i. O(log n) amortized.
u32 find_set(u32* parent, u32 i);
// Unites the sets of a and b. O(log n) amortized.
void join_sets(u32* parent, u32 a, u32 b);

// Parents that are fields of records: parent(i) is a reference to the parent of i.
template <class ParentOf>
u32 find_set(ParentOf parent, u32 i) {
  while (parent(i) != i) i = parent(i) = parent(parent(i));
  return i;
}
template <class ParentOf>
void join_sets(ParentOf parent, u32 a, u32 b) {
  a = find_set(parent, a);
  b = find_set(parent, b);
  parent(max_of(a, b)) = min_of(a, b);
}

}  // namespace tpa
