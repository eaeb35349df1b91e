// SPDX-License-Identifier: MIT
// candidates: triangulations that close or connect loops, drawn from several sources in turn. The caller tests each
// candidate for intersections and takes the first without any (paper section 5, steps 5 to 7; docs/handles.md).
//
// One loop gets its shortest cap. Several loops get handles, source after source:
// - Two to four loops of at most 15 vertices: the handles of the database in order of length.
// - Two loops: strips in order of length.
// - Three or more loops: handles cut open along a tree of short edges.
// Every handle between k loops with mu vertices is consistent: mu + 2k - 4 faces, no edge inside a loop, no edge twice.
#pragma once

#include "triangulate/face_filter.h"
#include "triangulate/minimum_triangulation.h"
#include "triangulate/rank_stored.h"
#include "triangulate/strips_in_order.h"

namespace tpa {

// A closed polygon, in the direction of the new faces along its edges.
struct Loop {
  const Vec3* points = nullptr;
  u32 count = 0;
};

inline constexpr u32 most_candidates = 256;

struct CandidateOptions {
  u32 max_candidates = 64;  // at most most_candidates
  // Rules faces out from the start. Heeded by strips up to 96 vertices, by caps and handles through a tree. Corners of
  // a face count the vertices of all loops, one loop after the other.
  FaceFilter filter;
  Meter* meter = nullptr;  // where it stops, there are no more candidates
};

// Loops with so many vertices together have candidates: with two corners more for each loop but the first, they are a
// disc of the longest size or less. The exact cut closes what is longer.
inline constexpr u32 longest_piece = longest_disc, most_loops_joined = most_cut_loops;
constexpr bool has_candidates(u64 vertices, u64 loops) {
  return loops >= 1 && loops <= most_loops_joined && vertices + 2 * (loops - 1) <= longest_piece;
}

struct CandidateSearch;
// Writes candidate number search.drawn of a source. False if the source has no more candidates.
using CandidateSource = bool (*)(CandidateSearch& search, FaceCorners* out);
inline constexpr u32 most_sources = 2;

// A search in progress. Its pointers lead into the caller's scratch, which must live as long.
struct CandidateSearch {
  Span<const Loop> loops;
  CandidateOptions options;
  u32 vertices = 0;
  CandidateSource sources[most_sources] = {};  // in the order of their turns
  u32 source_count = 0;
  u32 source = 0;        // the source in turn
  u32 drawn = 0;         // candidates of the source in turn
  u32 given = 0;         // different candidates given to the caller, of all sources
  u32 ranked_count = 0;  // handles in `ranked`
  Vec3* points = nullptr;
  u32* loop_of = nullptr;          // per vertex
  u32* first = nullptr;            // loop l has the vertices first[l] .. first[l + 1] - 1
  u32* numbers = nullptr;          // 0, 1, 2 ..
  u64* seen = nullptr;             // digests of the candidates given
  RankedHandle* ranked = nullptr;  // the shortest stored handles
  StripOrder strips;               // in `room`
  u32* corners = nullptr;
  DiscNotes disc_notes;
  u8* room = nullptr;  // each source in turn uses all of it
  u64 room_size = 0;
};

// Bytes of scratch for so many vertices in so many loops.
u64 candidate_scratch_bytes(u64 vertices, u64 loops);
// Faces of any candidate: vertices - 2 for a cap, mu + 2k - 4 for a handle.
u32 candidate_face_count(Span<const Loop> loops);

// Prepares a search. False if a loop has less than three vertices, without has_candidates(), or if the scratch does not
// suffice. Pre: scratch aligned to 8 bytes.
bool begin(CandidateSearch& search, Span<const Loop> loops, Span<u8> scratch, const CandidateOptions& options);

// Writes the next candidate, of `count` faces. Corners count the vertices of all loops, one loop after the other. No
// set of faces comes twice. False if no candidate is left, or if `out` is too small.
bool next(CandidateSearch& search, Span<FaceCorners> out, u32& count);

}  // namespace tpa
