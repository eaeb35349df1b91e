// candidates: triangulations that close or connect loops, one after another, for a caller who tests each for
// intersections and takes the first that is free (paper section 5, steps 5 to 7; docs/handles.md).
//
// One loop: caps. Two to four loops of at most 15 vertices: the handles of the database in order of length. Then, or
// at once where loops are longer: two get strips in order of length, or zippers; more get stored handles shortened by
// flips, handles through a tree of short edges, loops woven in one by one. Every candidate is a consistent handle:
// mu + 2k - 4 faces, no edge inside a loop, no edge twice.
#pragma once

#include "triangulate/face_filter.h"
#include "triangulate/loop_insertion.h"
#include "triangulate/rank_stored.h"
#include "triangulate/strips_in_order.h"

namespace tpa {

// A closed loop, in the direction in which the faces to be made traverse its edges.
struct Loop {
  const Vec3* points = nullptr;
  u32 count = 0;
};

// Corners are indices into the concatenation of all loops.
using CandidateFace = HandleFace;

inline constexpr u32 most_candidates = 256;

struct CandidateOptions {
  u32 max_candidates = 64;  // at most most_candidates
  // Strips in order, handles through a tree and caps have free faces only (the former up to 96 vertices, the others as
  // far as the scratch allows). Corners as in CandidateFace.
  FaceFilter filter;
};

// A search in progress. Plain data; the scratch that it points into must live as long, and belongs to it.
struct CandidateSearch {
  Span<const Loop> loops;
  CandidateOptions options;
  u32 vertices = 0;
  u32 given = 0;  // candidates so far
  u32 stage = 0;  // which source is being drawn from, and how far it has been drawn
  u32 drawn = 0;
  u32 ranked_count = 0;
  Vec3* points = nullptr;
  u32 *loop_of = nullptr, *first = nullptr, *numbers = nullptr;
  u64* seen = nullptr;  // digests of the candidates so far
  RankedHandle* ranked = nullptr;
  f64* start_length = nullptr;
  StripOrder strips;  // in the room
  WeaveScratch weave;
  u32* corners = nullptr;
  u8* room = nullptr;  // shared by the stages: all that is left of the scratch
  u64 room_size = 0;
};

// Bytes of scratch for loops of so many vertices in all. Linear in both.
u64 candidate_scratch_bytes(u64 vertices, u64 loops);
// Faces of any candidate: count - 2 for a cap, mu + 2k - 4 for a handle.
u32 candidate_face_count(Span<const Loop> loops);

// Prepares a search. False where a loop has less than three vertices, there is none, or the scratch (aligned
// to 8 bytes) does not suffice.
bool begin(CandidateSearch& search, Span<const Loop> loops, Span<u8> scratch, const CandidateOptions& options);

// The next candidate that has not been given yet. False when there is none left, or `out` is too small.
bool next(CandidateSearch& search, Span<CandidateFace> out, u32& count);

}  // namespace tpa
