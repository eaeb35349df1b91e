// SPDX-License-Identifier: MIT
// arena: one caller-supplied block, cut into tables by a single routine for measuring and for placing, so that
// tpa_arena_query and tpa_init cannot disagree. Positions are offsets: a byte copy of the block is a snapshot.
#pragma once

#include "base/base.h"

namespace tpa {

// Tables start on a cache line, so that two threads never share a line.
inline constexpr u64 arena_alignment = 64;
// Enough for every type of element; for arrays of a single thread.
inline constexpr u64 element_alignment = 8;

constexpr u64 aligned_size(u64 bytes, u64 alignment) { return (bytes + alignment - 1) / alignment * alignment; }

struct Table {
  u64 offset = 0;  // from the start of the block
  u64 element_bytes = 0;
  u64 count = 0;  // elements that fit
};

// Places the tables of the arena in order. Overflow is sticky: callers ask `ok` once, at the end.
struct Layout {
  u64 bytes = 0;
  bool ok = true;

  Table place(u64 element_bytes, u64 count) {
    const Table table{bytes, element_bytes, count};
    u64 size = 0, end = 0, padded = 0;
    ok = ok && checked_mul(element_bytes, count, size) && checked_add(bytes, size, end) &&
         checked_add(end, arena_alignment - 1, padded);
    if (ok) bytes = aligned_size(end, arena_alignment);
    return table;
  }
};

// Hands out arrays within a table, one behind the other. Without memory a carver only measures, by the same calls, so
// that size and layout cannot disagree.
struct Carver {
  u8* memory = nullptr;  // aligned as the arrays
  u64 alignment = arena_alignment;
  u64 bytes = 0;  // taken so far

  template <class T>
  void take(T*& array, u64 count) {
    array = memory == nullptr ? nullptr : reinterpret_cast<T*>(memory + bytes);
    bytes = aligned_size(bytes + count * sizeof(T), alignment);
  }
  template <class T>
  void take(Span<T>& span, u32 count) {
    take(span.data, count);
    span.size = count;
  }
  template <class T>
  void take(Stack<T>& stack, u32 count) {
    take(stack.data, count);
    stack.capacity = count;
    stack.size = 0;
  }
};

}  // namespace tpa
