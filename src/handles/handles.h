// SPDX-License-Identifier: MIT
// handles: the database of handles (paper section 4; docs/handles.md), a pure function of k and the sides of the
// polygons.
//
// The rule: a handle for the key (k; lambda_1..lambda_k) triangulates a sphere with k polygonal holes, has no vertex of
// its own and no edge inside a polygon. The database holds handles with the smallest sum of squared numbers of faces
// over the vertices. Rotations of a polygon, and exchanges of polygons with equal sides, turn handles into each other:
// these make up one orbit, stored as one generator. Sides may come in any order.
//
// Stored for sides from 3 to 15: all generators of the rule for pairs; for triples whose longest polygon has at most
// two vertices less than the others together; for every key with at most 32 generators. Other keys have the 32 most
// even generators: the smallest sums of squares of the strips' numbers of faces, tetrahedral plans before rows
// (handles/words.h). key_is_complete() tells whether a key has all.
//
// Generators come in order of unevenness, then of their codes (handles/handle_table.h). Keys without alternating
// handles have words as generators, in order of unevenness, then of compare() in handles/exchange.h. Pairs are in order
// of codes.
//
// Vertices are numbered 0 .. mu - 1 through the polygons in the caller's order. Every edge of a polygon, from a vertex
// to the next, is traversed in this direction by exactly one face.
#pragma once

#include "handles/words.h"

namespace tpa {

// Pre of all functions below: 2 <= k <= 4 and 3 <= sides <= 15, unless said otherwise.
struct HandleKey {
  u32 k = 0;
  u32 sides[max_handle_polygons] = {};
};

// Faces of every handle of the key: mu + 2k - 4.
u32 handle_face_count(const HandleKey& key);

// Generators in the database, at least one.
u32 generator_count(const HandleKey& key);
// Are the generators all handles of the rule?
bool key_is_complete(const HandleKey& key);
// Distinct labelled handles in the orbit of generator g, and in all orbits.
u64 generator_size(const HandleKey& key, u32 g);
u64 handle_count(const HandleKey& key);

// Write the faces of generator g, and of the index-th labelled handle. Handles come generator by generator, within an
// orbit exchange by exchange, lexicographically; within an exchange, the rotation of the longest polygon turns fastest.
// False where g, index or the room are out of range; otherwise the first handle_face_count() faces are written.
bool generator_get(const HandleKey& key, u32 g, Span<FaceCorners> out);
bool handle_get(const HandleKey& key, u64 index, Span<FaceCorners> out);

// For choices by coordinates: the polygons sorted, longest first; order[i] is the caller's number.
struct SortedKey {
  u32 k = 0;
  u32 sides[max_handle_polygons] = {};
  u32 order[max_handle_polygons] = {};
};
SortedKey sorted_key(const HandleKey& key);  // of any sides
bool is_tabled(const SortedKey& key);        // are all sides at most 15, and so many polygons compiled in?
u32 tabled_generator_count(const SortedKey& key);
// Rotations of the longest polygon with different images of generator g.
u32 distinct_rotations(const SortedKey& key, u32 g);
// Generator g in words. Pre: is_tabled(key), g < generator_count.
WordHandle tabled_generator(const SortedKey& key, u32 g);
// The distinct images of a generator under exchanges. Returns their number, at most 24.
u32 exchange_images(const SortedKey& key, const WordHandle& generator, WordHandle (&images)[24]);

}  // namespace tpa
