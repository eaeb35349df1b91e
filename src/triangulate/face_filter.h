// face_filter: which faces may be part of a handle at all (paper section 5, step 6: the handle must not intersect the
// mesh). A face that meets the mesh rules out every handle that has it, so searches for handles in order of length
// leave such faces out from the start.
#pragma once

#include "base/arena.h"
#include "handles/words.h"

namespace tpa {

// Asks the caller, who knows the mesh. Without `ask` all faces are free.
struct FaceFilter {
  bool (*ask)(void* caller, const HandleFace& face) = nullptr;
  void* caller = nullptr;
};
inline bool is_free(const FaceFilter& filter, u32 a, u32 b, u32 c) {
  return filter.ask == nullptr || filter.ask(filter.caller, {{a, b, c}});
}

// The answers for faces of a certain kind, by their places.
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
// Is the face at this place free? The caller is asked the first time only. Pre: filter.ask.
inline bool is_free(const FaceFilter& filter, const FaceMemory& memory, u64 place, const HandleFace& face) {
  const u64 word = place / 64, bit = u64{1} << (place % 64);
  if ((memory.asked[word] & bit) == 0) {
    memory.asked[word] |= bit;
    if (filter.ask(filter.caller, face)) memory.free[word] |= bit;
  }
  return (memory.free[word] & bit) != 0;
}

// The answers for some faces of a kind that has too many for a bit each: an open hash, by their places.
struct FaceTable {
  u32* slots = nullptr;  // 2 * place + (free ? 1 : 0), or none; a power of two of them
  u32 size = 0, used = 0;
};
inline void forget(FaceTable& table) {
  for (u32 i = 0; i < table.size; ++i) table.slots[i] = none;
  table.used = 0;
}
// The slot of this place, or the empty one where it belongs.
inline u32& slot_of(const FaceTable& table, u32 place) {
  u32 i = static_cast<u32>(place * scattering >> 32) & (table.size - 1);
  while (table.slots[i] != none && table.slots[i] / 2 != place) i = (i + 1) & (table.size - 1);
  return table.slots[i];
}

}  // namespace tpa
