// SPDX-License-Identifier: MIT
// minimum_triangulation: the best triangulation of a polygon in space by dynamic programming (Klincsek 1980; Barequet &
// Sharir 1995). Cut along a shortest tree of edges that connects its polygons, a handle is a disc too, whose best
// triangulation is found exactly. Serves caps, and handles beyond the database (paper section 5).
#pragma once

#include "base/arena.h"
#include "base/meter.h"
#include "base/vec3.h"
#include "triangulate/face_filter.h"

namespace tpa {

// O(n^3) time: 6 ms for the longest polygon.
inline constexpr u32 longest_disc = 384;

// The sides of a triangulation with a face; each side stands after the side beyond its face.
struct SplitSide {
  u16 from, to, beyond;
  bool stale;  // its cost in the table may differ from the cost of its best split
};
struct SplitSides {
  SplitSide* at = nullptr;
  u32 size = 0;
};
// Arrays of a search, an element for each corner, in the caller's scratch.
struct DiscNotes {
  SplitSides ahead, sides;
  u32 *vertex_at = nullptr, *place = nullptr;  // of a handle that is cut open
};
inline void carve(Carver& carver, u64 corners, DiscNotes& notes) {
  carver.take(notes.ahead.at, corners);
  carver.take(notes.sides.at, corners);
  carver.take(notes.vertex_at, corners);
  carver.take(notes.place, corners);
}

// A closed polygon with corners 0 .. n-1; a vertex may be at several corners.
struct Disc {
  const Vec3* points = nullptr;  // by vertex
  const u32* vertex = nullptr;   // of each corner
  u32 n = 0;
  const u32* loop_of = nullptr;     // by vertex; chords within a loop are not allowed. nullptr: all chords are
  const u32 (*taken)[2] = nullptr;  // pairs of vertices with an edge already
  u32 taken_count = 0;
  FaceFilter filter;  // faces that are not free are left out
  DiscNotes* notes = nullptr;
  Meter* meter = nullptr;
};

constexpr u64 disc_scratch_bytes(u64 n) { return n * (n - 1) / 2 * sizeof(f64) + 64; }
// With a filter, the answers of the caller are remembered, up to three quarters of so many. A search asks some three
// questions for each two corners; rims that fold over take some thousands.
inline constexpr u32 disc_table_slots = 1 << 13;
constexpr u64 filtered_disc_scratch_bytes(u64 n) { return disc_scratch_bytes(n) + disc_table_slots * sizeof(u32); }

// Writes the n - 2 faces of the triangulation with the shortest chords, with vertices as corners, in the direction of
// the polygon. False where the rules leave no triangulation, or none without a repeated edge, where the memory of
// answers is full before one of free faces is found, or if the meter stops. Pre: 3 <= n <= longest_disc, scratch of
// disc_scratch_bytes(n), or of filtered_disc_scratch_bytes(n) with a filter; aligned for f64.
bool best_disc(const Disc& disc, u8* scratch, FaceCorners* out);

struct LoopsToCutOpen {
  const Vec3* points = nullptr;
  const u32* loop_of = nullptr;
  const u32* first = nullptr;  // loop l has vertices first[l] .. first[l + 1] - 1
  u32 count = 0;
  FaceFilter filter;
  DiscNotes* notes = nullptr;
  Meter* meter = nullptr;
};
inline constexpr u32 most_cut_loops = 16;

// The handle of least total edge length among the handles that contain a certain tree. Variant 0 has the shortest tree;
// variant i < count has the shortest tree without a connection of the two loops that edge number i - 1 of the former
// connects. False where there is none. Writes vertices + 2 * loops - 4 faces. Pre: 2 <= loops <= most_cut_loops, n =
// vertices + 2 * loops - 2 <= longest_disc, `corners` has room for n, the scratch is enough for a filtered disc of n.
bool cut_open_handle(const LoopsToCutOpen& loops, u32 variant, u32* corners, u8* scratch, FaceCorners* out);

}  // namespace tpa
