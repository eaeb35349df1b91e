// four_best: as many handles between four polygons as are wanted, in order of length (docs/handles.md).
#pragma once

#include "triangulate/four_base.h"

namespace tpa {

struct ShortHandle {
  f64 length = 0;  // of all edges that are not a polygon's
  u32 place = 0;   // of its faces
};

struct ShortHandles {
  Span<ShortHandle> best;  // of these, `count` so far
  u32 count = 0;
  u16* apex = nullptr;  // of each handle: of the faces over the polygons' edges, then corners of inner triangles
};

constexpr u32 loop_of(const ShortLoops& loops, u32 v) {
  u32 l = 0;
  while (v >= loops.first[l + 1]) ++l;
  return l;
}

// What one takes of the scratch.
u64 short_handle_bytes(const ShortLoops& loops);
void lay_out_short_handles(Carver& carver, const ShortLoops& loops, u32 handles, ShortHandles& out);

// Enters a handle that is shorter than the last of as many as are wanted, or where there are fewer; after those of its
// length. `face` are its mu + 4 faces.
void enter_handle(const ShortLoops& loops, f64 length, const HandleFace* face, ShortHandles& handles);
// The faces of a handle that was found.
void write_four(const ShortLoops& loops, const ShortHandles& handles, u32 number, HandleFace* out);

}  // namespace tpa
