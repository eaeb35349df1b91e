// SPDX-License-Identifier: MIT
#include "results/changes.h"

namespace tpa {

namespace {

// Calls visit(first, end) for the ranges.
template <class Visit>
void for_each_range(const BitSet& set, u32 gap, Visit visit) {
  u32 first = none, end = 0;
  for (u32 i : set) {
    if (first != none && i - end > gap) {
      visit(first, end);
      first = i;
    }
    if (first == none) first = i;
    end = i + 1;
  }
  if (first != none) visit(first, end);
}

}  // namespace

u32 count_members(const BitSet& set) {
  u32 count = 0;
  for_each_range(set, 0, [&](u32 first, u32 end) { count += end - first; });
  return count;
}

u32 list_ranges(const BitSet& set, u32 gap, tpa_range* ranges, u32 capacity) {
  for (;;) {
    u32 count = 0;
    for_each_range(set, gap, [&](u32 first, u32 end) {
      if (count < capacity) ranges[count] = {first, end - first};
      ++count;
    });
    if (count <= capacity) return count;
    gap = gap >= none / 2 ? none : 2 * gap + 1;
  }
}

}  // namespace tpa
