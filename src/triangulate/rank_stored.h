// SPDX-License-Identifier: MIT
// rank_stored: which stored handles are the shortest for polygons with given coordinates (paper section 5, steps 5
// and 7).
//
// The length of a handle is a sum over its strips, and the length of a strip depends on the rotations of two polygons
// only. So one matrix for each pair of polygons gives the length of every rotation of a generator, and no handle is
// ever written out to be measured.
#pragma once

#include "base/meter.h"
#include "base/vec3.h"
#include "handles/handles.h"

namespace tpa {

// A handle of the database: the numbers of its generator and of the image under exchanges, and the rotations.
struct RankedHandle {
  f64 length = 0;
  u8 generator = 0;
  u8 image = 0;
  u8 rotation[max_handle_polygons] = {};
};

// Room for the distances between all pairs of four polygons, written round and round, and the pair matrices.
struct ChoiceScratch {
  static constexpr u32 side = 15, pairs = 6;
  f64 distance[pairs][2 * side][2 * side];
  f64 matrix[pairs][side][side + 1];  // filled eight columns at a time
};

// Fills `best` with the shortest handles in order of length, ties in order of the database; returns their number.
// points[i] are the vertices of sorted polygon i. Pre: is_tabled(key). Order of growth: generators * images * (mu * 15
// + 15^(k-1)), and for k = 4 as much of it as a bound does not rule out. None if the meter stops.
u32 rank_handles(const SortedKey& key, const Vec3* const (&points)[max_handle_polygons], ChoiceScratch& scratch,
                 Span<RankedHandle> best, Meter* meter = nullptr);

// Writes the faces of a handle; the vertices of the caller's polygon l start at first[l].
void write_ranked(const SortedKey& key, const RankedHandle& handle, const u32* first, FaceCorners* out);

}  // namespace tpa
