// face_filter: which faces may be part of a handle at all (paper section 5, step 6: the handle must not intersect the
// mesh). A face that meets the mesh rules out every handle that has it, so searches for handles in order of length
// leave such faces out from the start.
#pragma once

#include "handle_words.h"

namespace tpa {

// Asks the caller, who knows the mesh. Without `ask` all faces are free.
struct FaceFilter {
  bool (*ask)(void* caller, const HandleFace& face) = nullptr;
  void* caller = nullptr;
};
inline bool is_free(const FaceFilter& filter, u32 a, u32 b, u32 c) {
  return filter.ask == nullptr || filter.ask(filter.caller, {{a, b, c}});
}

// The answers for faces over a polygon's edge, for up to 60 vertices: bit w of word v stands for the face over the
// edge from v, with apex w.
struct FaceMemory {
  static constexpr u32 most_vertices = 60;
  u64 asked[most_vertices], free[most_vertices];
};
inline void forget(FaceMemory& memory) {
  for (u32 v = 0; v < FaceMemory::most_vertices; ++v) memory.asked[v] = memory.free[v] = 0;
}
inline bool is_free(const FaceFilter& filter, FaceMemory& memory, u32 v, u32 next, u32 apex) {
  if (filter.ask == nullptr) return true;
  const u64 bit = u64{1} << apex;
  if ((memory.asked[v] & bit) == 0) {
    memory.asked[v] |= bit;
    if (is_free(filter, v, next, apex)) memory.free[v] |= bit;
  }
  return (memory.free[v] & bit) != 0;
}

}  // namespace tpa
