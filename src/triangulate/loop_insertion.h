// SPDX-License-Identifier: MIT
// loop_insertion: a handle for any number of loops of any length, made by weaving loops into strips one by one
// (docs/handles.md).
//
// Two loops get a closed strip. A further loop takes the place of one face: the face's corners and the loop are again
// two polygons with a closed strip between them. All new edges lead from the loop to three different vertices, so the
// handle stays consistent. Flips of edges then shorten it. A flip that would make an edge inside a loop, or a second
// edge between two vertices, is not done.
#pragma once

#include "base/meter.h"
#include "triangulate/strip.h"

namespace tpa {

// Loops one after another: loop l has the vertices first[l] .. first[l + 1] - 1.
struct WeaveLoops {
  const Vec3* points = nullptr;
  const u32* loop_of = nullptr;
  const u32* first = nullptr;
  const u32* numbers = nullptr;  // 0, 1, 2 ..
  u32 count = 0;
  Meter* meter = nullptr;
};

struct WeaveScratch {
  Span<u32> half_edges;  // slots of a hash
  Span<u32> twin;        // 3 for each face
  Span<u8> strip;        // aligned for f64
};

constexpr u64 weave_faces(u64 vertices, u64 loops) { return vertices + 2 * loops; }
// Six or more for each edge of a handle.
constexpr u64 weave_hash_slots(u64 vertices, u64 loops) {
  u64 slots = 16;
  while (slots < 3 * weave_faces(vertices, loops) + vertices) slots *= 2;
  return 3 * slots;
}
constexpr u64 weave_strip_bytes(u64 vertices) { return (4 * (vertices + 1) + 65536) / 8 * 8; }

// Weaves all loops, beginning with loop `start` and going on with the nearest by centre; returns the number of faces.
// O(k^2 mu) for k loops and mu vertices. Pre: at least two loops.
u32 weave_loops(const WeaveLoops& loops, u32 start, const WeaveScratch& scratch, FaceCorners* faces);

// Flips edges as long as that shortens the handle, at most `sweeps` times over all edges. O(faces) for each sweep as a
// rule; before a flip, the faces round one vertex are looked at.
void shorten_by_flips(const WeaveLoops& loops, u32 sweeps, const WeaveScratch& scratch, Span<FaceCorners> faces);

}  // namespace tpa
