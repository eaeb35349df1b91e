// SPDX-License-Identifier: MIT
// close_holes: closes the holes of a piece with new surface (section 5, steps 5 to 7). Handles are tried in the order
// of edge lengths, until one is free of intersections or trusted to be so.
#pragma once

#include "surgery/cut_and_sew.h"
#include "triangulate/candidates.h"

namespace tpa {

// Bytes of scratch for searches across loops with at most `vertices` vertices together.
u64 closing_scratch_bytes(u32 vertices);

// For the vertices of the longest piece.
struct ClosingScratch {
  Stack<u32> placed;            // new faces placed so far; two for each vertex
  Span<u32> vertices, borders;  // of the loops in hand
  Span<Vec3> points;
  Span<Loop> polygons;    // most_loops_joined, or as many as there can be
  Span<u8> search;        // closing_scratch_bytes()
  u32* sewing = nullptr;  // twelve for each vertex
};

// Are candidates tested for intersections, or is the first taken, for the caller to test? Trust is limited to pieces of
// several loops.
enum class Candidates : u8 { tested, trusted };

struct PieceOutcome {
  bool done = false;  // the holes of the piece are closed; and unless `trusted`, the new faces meet nothing
  bool out_of_faces = false;
  bool trusted = false;  // an untested candidate was placed, and may meet something
};

// Is the piece short enough for candidates?
bool can_be_closed(const Clusters& r, const Piece& piece);
// The vertices that closing_scratch_bytes() has to hold for a piece: those of its loops, and two more for each loop
// beyond the second. Pre: can_be_closed().
u64 room_to_close(const Clusters& r, const Piece& piece);

// Closes the holes of one piece, after cut(): a single loop by a cap, several by a handle. If nothing fits, the
// holes stay open and `done` is false. Pre: can_be_closed(), and the scratch holds room_to_close().
PieceOutcome connect_piece(Edit& e, NearFaces& g, const Clusters& r, const Piece& piece,
                           const CandidateOptions& options, Candidates candidates, ClosingScratch& s);

}  // namespace tpa
