// open_hash: a table of indices with linear probing (Knuth 1973, The Art of Computer Programming, 6.4). The indices
// name elements of a list that the caller keeps; an empty slot holds `none`.
#pragma once

#include <string.h>

#include "base/base.h"

namespace tpa {

struct OpenHash {
  u32* slot = nullptr;
  u32 size = 0;  // more than there are elements; searches stay short at twice their number

  void clear() { memset(slot, 0xFF, static_cast<size_t>(size) * sizeof(u32)); }

  // The slot of the element with this hash for which is_wanted(index) is true, or the empty slot where it belongs.
  // Equal elements have equal hashes; the upper bits of a hash matter most. Expected O(1).
  template <class IsWanted>
  u32& find(u32 hash, IsWanted is_wanted) const {
    u32 at = static_cast<u32>(u64{hash} * size >> 32);
    while (slot[at] != none && !is_wanted(slot[at])) at = at + 1 < size ? at + 1 : 0;
    return slot[at];
  }
};

// Hash of one number, for OpenHash.
constexpr u32 scattered(u32 a) { return static_cast<u32>(a * scattering >> 32); }

}  // namespace tpa
