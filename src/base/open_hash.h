// SPDX-License-Identifier: MIT
// open_hash: a table of indices with linear probing (Knuth 1973, The Art of Computer Programming, 6.4). The indices
// name elements of a list that the caller keeps; an empty slot holds `none`.
#pragma once

#include <string.h>

#include "base/base.h"

namespace tpa {

struct OpenHash {
  u32* slot = nullptr;
  u32 size = 0;  // more than there are elements; searches stay short up to a half full table

  void clear() { memset(slot, 0xFF, static_cast<size_t>(size) * sizeof(u32)); }

  void fetch_slot(u32 hash) const { fetch(slot + (u64{hash} * size >> 32)); }

  // The slot of the element with this hash and a true is_wanted(index), or the empty slot for such an element. Equal
  // elements have equal hashes; the upper bits of a hash matter most. Expected O(1).
  template <class IsWanted>
  u32& find(u32 hash, IsWanted is_wanted) const {
    u32 at = static_cast<u32>(u64{hash} * size >> 32);
    while (slot[at] != none && !is_wanted(slot[at])) at = at + 1 < size ? at + 1 : 0;
    return slot[at];
  }
};

}  // namespace tpa
