// arena: one caller-supplied block, cut into regions by a single routine that serves measuring and placing alike, so
// that tpa_arena_query and tpa_init cannot disagree. Positions are offsets: a byte copy of the block is a snapshot.
#pragma once

#include "base/base.h"

namespace tpa {

// Every region starts on a cache line, so that two workers never share one.
inline constexpr u64 arena_alignment = 64;

struct Table {
  u64 offset = 0;  // from the start of the block
  u64 element_bytes = 0;
  u64 count = 0;  // elements that fit
};

// Runs through the regions in order. Overflow is sticky: ask `ok` once, at the end.
struct Layout {
  u64 bytes = 0;
  bool ok = true;

  Table place(u64 element_bytes, u64 count) {
    const Table r{bytes, element_bytes, count};
    u64 size = 0, end = 0, padded = 0;
    ok = ok && checked_mul(element_bytes, count, size) && checked_add(bytes, size, end) &&
         checked_add(end, arena_alignment - 1, padded);
    if (ok) bytes = padded / arena_alignment * arena_alignment;
    return r;
  }
};

// Hands out arrays within a region, one behind the other; without memory it only measures.
struct Carver {
  u8* memory;
  u64 bytes = 0;

  template <class T>
  void take(T*& p, u64 count) {
    if (memory != nullptr) p = reinterpret_cast<T*>(memory + bytes);
    bytes = (bytes + count * sizeof(T) + arena_alignment - 1) / arena_alignment * arena_alignment;
  }
};

}  // namespace tpa
