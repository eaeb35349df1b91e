// SPDX-License-Identifier: MIT
// face_filter: faces that may be part of a handle (paper section 5, step 6: the handle must not intersect the mesh). A
// face that meets the mesh rules out every handle with it. Searches in order of length leave such faces out from the
// start.
#pragma once

#include "base/arena.h"
#include "base/meter.h"
#include "handles/words.h"

namespace tpa {

// A question to the caller, who knows the mesh. Without `ask` all faces are free.
struct FaceFilter {
  bool (*ask)(void* caller, const FaceCorners& face) = nullptr;
  void* caller = nullptr;
};
inline bool is_free(const FaceFilter& filter, u32 a, u32 b, u32 c) {
  return filter.ask == nullptr || filter.ask(filter.caller, {{a, b, c}});
}

// The answers for faces of a certain kind, by number.
struct FaceMemory {
  u64 *asked = nullptr, *free = nullptr;  // bits
  u64 words = 0;
};
inline void lay_out_face_memory(Carver& carver, u64 places, FaceMemory& memory) {
  memory.words = (places + 63) / 64;
  carver.take(memory.asked, memory.words), carver.take(memory.free, memory.words);
}
inline void forget(const FaceMemory& memory) {
  for (u64 word = 0; word < memory.words; ++word) memory.asked[word] = memory.free[word] = 0;
}
inline bool is_known(const FaceMemory& memory, u64 place) { return (memory.asked[place / 64] >> (place % 64)) & 1; }
// Is the face of this number free? The caller is asked the first time only. Pre: filter.ask.
inline bool is_free(const FaceFilter& filter, const FaceMemory& memory, u64 place, const FaceCorners& face) {
  const u64 word = place / 64, bit = u64{1} << (place % 64);
  if ((memory.asked[word] & bit) == 0) {
    memory.asked[word] |= bit;
    if (filter.ask(filter.caller, face)) memory.free[word] |= bit;
  }
  return (memory.free[word] & bit) != 0;
}

}  // namespace tpa
