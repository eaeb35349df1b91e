// SPDX-License-Identifier: MIT
// candidates: triangulations that close or connect loops, one after another. The caller tests each for intersections
// and takes the first without any (paper section 5, steps 5 to 7; docs/handles.md).
//
// One loop gets caps. Two to four loops of at most 15 vertices get the handles of the database in order of length.
// Then, or at once between longer loops: two loops get strips in order of length, or zippers; more loops get handles of
// the database shortened by flips, handles through a tree of short edges, and loops woven in one by one. Every handle
// is consistent: mu + 2k - 4 faces, no edge inside a loop, no edge twice.
#pragma once

#include "triangulate/face_filter.h"
#include "triangulate/loop_insertion.h"
#include "triangulate/rank_stored.h"
#include "triangulate/strips_in_order.h"

namespace tpa {

// A closed loop, in the direction of the new faces along its edges.
struct Loop {
  const Vec3* points = nullptr;
  u32 count = 0;
};

inline constexpr u32 most_candidates = 256;

struct CandidateOptions {
  u32 max_candidates = 64;  // at most most_candidates
  // Caps, strips in order and handles through a tree have free faces only: strips up to 96 vertices, the others as far
  // as the scratch allows. Corners count the vertices of all loops, one loop after the other.
  FaceFilter filter;
};

struct CandidateSearch;
// Writes candidate number search.drawn of a source. False where the source has no more.
using CandidateSource = bool (*)(CandidateSearch& search, FaceCorners* out);
inline constexpr u32 most_sources = 4;

// A search in progress. Its pointers lead into the caller's scratch, which must live as long.
struct CandidateSearch {
  Span<const Loop> loops;
  CandidateOptions options;
  u32 vertices = 0;
  CandidateSource sources[most_sources] = {};  // in the order of their turns
  u32 source_count = 0;
  u32 source = 0;  // the source in turn
  u32 drawn = 0;   // candidates of the source in turn
  u32 given = 0;   // candidates of all sources, each counted once
  u32 ranked_count = 0;
  Vec3* points = nullptr;
  u32 *loop_of = nullptr, *first = nullptr, *numbers = nullptr;
  u64* seen = nullptr;  // digests of the candidates given
  RankedHandle* ranked = nullptr;
  f64* start_length = nullptr;
  StripOrder strips;  // in the room
  WeaveScratch weave;
  u32* corners = nullptr;
  u8* room = nullptr;  // the rest of the scratch: each source in turn uses all of it
  u64 room_size = 0;
};

// Bytes of scratch for so many vertices in so many loops. Linear in both.
u64 candidate_scratch_bytes(u64 vertices, u64 loops);
// Faces of any candidate: vertices - 2 for a cap, mu + 2k - 4 for a handle.
u32 candidate_face_count(Span<const Loop> loops);

// Prepares a search. False where a loop has less than three vertices, where no loop is given, and where the scratch
// does not suffice. Pre: scratch aligned to 8 bytes.
bool begin(CandidateSearch& search, Span<const Loop> loops, Span<u8> scratch, const CandidateOptions& options);

// Writes the next candidate; corners count the vertices of all loops, one loop after the other. No set of faces comes
// twice. False when no candidate is left, or `out` is too small.
bool next(CandidateSearch& search, Span<FaceCorners> out, u32& count);

}  // namespace tpa
