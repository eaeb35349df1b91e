// room: tables whose sizes are known only when they are laid out, one after another in scratch.
#pragma once

#include "base/base.h"

namespace tpa {

// Measures and hands out by the same calls, so that the two cannot disagree: without a base, it only measures.
struct Room {
  u8* base = nullptr;  // aligned for f64
  u64 used = 0;
  template <class T>
  T* take(u64 count) {
    T* at = base == nullptr ? nullptr : reinterpret_cast<T*>(base + used);
    used += (count * sizeof(T) + 7) / 8 * 8;
    return at;
  }
};

}  // namespace tpa
