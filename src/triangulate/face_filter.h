// SPDX-License-Identifier: MIT
// face_filter: faces that may be part of a handle (paper section 5, step 6: the handle must not intersect the mesh). A
// face that meets the mesh rules out every handle with it. Searches in order of length leave such faces out from the
// start.
#pragma once

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

}  // namespace tpa
