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

// Units of work of a strip.
constexpr u64 strip_work(u64 p, u64 q) { return 1 + p + q + p * q / 8; }
// The lengths of the shortest strips that start at the edges (x_0, y_first) .. (x_0, y_{end - 1}), `first` even, into
// lengths[0 ..]. O(p q) for each start. Pre: at least three vertices in both loops, scratch of at least 4 (q + 1)
// doubles; with more, fewer distances are computed again.
void shortest_strip_lengths(const StripLoops& loops, u32 first, u32 end, Span<f64> scratch, f64* lengths);
// Lower bounds for the shortest strip from each start. O(p q) in all. Pre: scratch of p q + p + 2 q doubles.
void bound_strip_lengths(const StripLoops& loops, f64* scratch, f64* at_least);
// Sums of less than 2^12 lengths in different orders differ by less than this, relatively.
inline constexpr f64 strip_rounding = 1.0 / (u64{1} << 40);

}  // namespace tpa
