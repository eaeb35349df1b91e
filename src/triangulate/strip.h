// SPDX-License-Identifier: MIT
// strip: the shortest closed strip of faces between two loops (docs/handles.md; after Fuchs, Kedem and Uselton,
// "Optimal surface reconstruction from planar contours", 1977).
//
// A closed strip is a lattice path from edge (x_0, y_l) back to it, by p steps forwards on loop x and q steps backwards
// on loop y. It is a consistent handle unless all steps on one loop follow each other, when an edge would occur twice;
// such paths are left out. Every handle has exactly one edge at x_0 after a step on x. Paths that start at this edge
// and end with such a step are counted once each.
#pragma once

#include "base/vec3.h"
#include "handles/words.h"

namespace tpa {

// Two loops, as vertex numbers into `points`, both in handle direction.
struct StripLoops {
  const Vec3* points = nullptr;
  Span<const u32> x, y;
};

// Length of the edge from corner i of x to corner j of y.
inline f64 edge_length(const StripLoops& loops, u32 i, u32 j) {
  return length(loops.points[loops.x[i]] - loops.points[loops.y[j]]);
}

// Beyond this many cells, p q for each of q starts, the exact search gives way to the zipper: .05 seconds, enough for
// two loops of 256 vertices.
inline constexpr u64 exact_strip_work = u64{1} << 24;
// Units of work of a strip.
constexpr u64 strip_work(u64 p, u64 q) { return 1 + p + q + p * q / 8; }
// Bytes for the exact search between loops of p and q vertices.
constexpr u64 strip_scratch_bytes(u64 p, u64 q) { return (p + 1) * (q + 1) + 3 * sizeof(f64) * (q + 1); }
// Writes the p + q faces of the shortest strip that starts at edge (x_0, y_start), and returns its length. O(p q). Pre:
// at least three vertices in both loops, scratch of strip_scratch_bytes(p, q), aligned for f64.
f64 shortest_strip_from(const StripLoops& loops, u32 start, u8* scratch, FaceCorners* out);
// The length alone, with scratch of 3 (q + 1) doubles.
f64 shortest_strip_length(const StripLoops& loops, u32 start, u8* scratch);
// The same for the starts first .. end - 1, `first` even, into lengths[0 ..]. O(p q) for each start. Pre: scratch of at
// least 4 (q + 1) doubles; with more, fewer distances are computed again.
void shortest_strip_lengths(const StripLoops& loops, u32 first, u32 end, Span<f64> scratch, f64* lengths);
// Lower bounds for the shortest strip from each start. O(p q) in all. Pre: scratch of p q + p + 2 q doubles.
void bound_strip_lengths(const StripLoops& loops, f64* scratch, f64* at_least);
// Sums of less than 2^12 lengths in different orders differ by less than this, relatively.
inline constexpr f64 strip_rounding = 1.0 / (u64{1} << 40);

// The zipper: from edge (x_i, y_j), each step takes the shorter new edge. O(p + q).
void zip_strip(const StripLoops& loops, u32 i, u32 j, FaceCorners* out);
// The vertex of y nearest to x_i.
u32 nearest_on_y(const StripLoops& loops, u32 i);
// A pair of vertices that are each other's nearest, found by walking from x_0 to and fro. O(p + q) a round.
void nearest_pair(const StripLoops& loops, u32& i, u32& j);

}  // namespace tpa
