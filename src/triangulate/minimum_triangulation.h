// SPDX-License-Identifier: MIT
// minimum_triangulation: the best triangulation of a polygon in space by dynamic programming (Klincsek 1980; Barequet &
// Sharir 1995). Cut along a shortest tree of edges that connects its polygons, a handle is a disc too, whose best
// triangulation is found exactly. Serves caps, and handles beyond the database (paper section 5).
#pragma once

#include "base/vec3.h"
#include "triangulate/face_filter.h"

namespace tpa {

enum class DiscWeight : u8 {
  length,  // of the chords
  area,    // of the faces
  angle    // squared cosines of the faces' largest angles: prefers well shaped faces
};

// Cost of the triangle abc, by area or by angle.
f64 corner_cost(DiscWeight weight, const Vec3& a, const Vec3& b, const Vec3& c);

// O(n^3) time: 6 ms for the longest polygon with the weight by length, some 50 to 120 ms with the others.
inline constexpr u32 longest_disc = 384;

// The sides of a triangulation with a face; each side stands after the side beyond its face.
struct SplitSide {
  u16 from, to, beyond;
  bool stale;  // its cost in the table may differ from the cost of its best split
};
struct SplitSides {
  SplitSide at[longest_disc];
  u32 size;
};
// Arrays of a search, in the caller's scratch.
struct DiscNotes {
  SplitSides ahead, sides;
  u32 stale_from[longest_disc];                      // by corner
  u32 vertex_at[longest_disc], place[longest_disc];  // of a handle that is cut open
};

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
// With a filter, the answers for all faces are remembered up to so many corners; beyond, up to three quarters of so
// many answers. A search asks some three questions for each two corners; rims that fold over take some thousands.
inline constexpr u32 longest_remembered_disc = 96;
inline constexpr u32 disc_table_slots = 1 << 13;
inline constexpr u32 most_taken_faces = disc_table_slots / 4 * 3;
constexpr u64 corner_triples(u64 n) { return n * (n - 1) * (n - 2) / 6; }
constexpr u64 filtered_disc_scratch_bytes(u64 n) {
  return disc_scratch_bytes(n) + most_taken_faces * sizeof(u32) +
         (n <= longest_remembered_disc ? 2 * ((corner_triples(n) + 63) / 64) * sizeof(u64)
                                       : disc_table_slots * sizeof(u32));
}
// Corners of the longest disc that fits so many bytes.
u32 longest_disc_within(u64 bytes);

// Writes n - 2 faces with vertices as corners, in the direction of the polygon. False where the rules leave no
// triangulation, or none without a repeated edge, where none of free faces is found in time, or if the meter stops.
// Pre: 3 <= n <= longest_disc, scratch of disc_scratch_bytes(n), or of filtered_disc_scratch_bytes(n) with a filter;
// aligned for f64.
bool best_disc(const Disc& disc, DiscWeight weight, u8* scratch, FaceCorners* out);

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
// connects. False where there is none. Writes vertices + 2 * loops - 4 faces. Pre: `corners` has room for vertices + 2
// * loops.
bool cut_open_handle(const LoopsToCutOpen& loops, u32 variant, u32* corners, u8* scratch, u64 scratch_bytes,
                     FaceCorners* out);

}  // namespace tpa
