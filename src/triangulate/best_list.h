// SPDX-License-Identifier: MIT
// best_list: the shortest of many candidates, in order of length.
#pragma once

#include "base/base.h"

namespace tpa {

// T has a field `length`. Lists are short: insertion is O(size).
template <class T>
struct BestList {
  Span<T> at;     // room for as many as are wanted
  u32 count = 0;  // so many are known

  bool is_full() const { return count == at.size; }
  // Would a candidate of this length be among the shortest? Of equal lengths the earlier candidate stays.
  bool takes(f64 length) const { return !is_full() || length < at[count - 1].length; }
  // Behind all of its length; the longest falls out of a full list. Pre: takes(candidate.length).
  void enter(const T& candidate) {
    u32 place = is_full() ? count - 1 : count++;
    for (; place > 0 && candidate.length < at[place - 1].length; --place) at[place] = at[place - 1];
    at[place] = candidate;
  }
};

}  // namespace tpa
