// close_holes: which new surface closes the holes of a piece (section 5, steps 5 to 7)? Handles in the order of their
// edge length, the first that is free of intersections, or is taken to be; else caps.
#pragma once

#include "surgery/cut_and_sew.h"
#include "triangulate/advancing_front.h"

namespace tpa {

// How many vertices the loops of one piece may have together where a pass can cut so many edges, and how many edges
// that takes. A pass that cuts many does so in many places, and what searches want for a vertex is ten times a cut.
constexpr u32 longest_piece(u32 cuts) { return min_of(cuts, cuts / 4 + 512); }
constexpr u64 cuts_for_piece(u32 vertices) { return max_of<u64>(vertices, 4 * (max_of(vertices, 512u) - u64{512})); }

// Bytes of scratch that searches want when all loops together have so many vertices at most.
u64 closing_scratch_bytes(u32 vertices);

// For as many vertices as the longest piece has.
struct ClosingScratch {
  Stack<u32> placed;            // faces of the plan in hand; two for each vertex
  Span<u32> vertices, borders;  // of the loops in hand
  Span<Vec3> points;
  Span<u8> search;        // closing_scratch_bytes()
  Stack<u32> open;        // of a piece that is not done, the vertices of the holes that zip left
  u32* sewing = nullptr;  // twelve for each vertex
};

// What to do where no handle fits, from least to most.
enum class Otherwise : u8 {
  cut_less,   // as give_up; and several loops of one cluster are not zipped: next time less of it goes
  give_up,    // for loops that have no handle to be joined by: a cap that meets nothing, or nothing
  cap,        // a cap on each loop that meets nothing, or nothing
  cap_anyhow  // a cap on each loop, even if it meets something: adapt treats that as it does other tangles
};

// Are candidates tested for intersections, or is the first one taken? Then the caller finds out. Only where no cluster
// of a group has two loops, and all are joined: else a candidate that is not free may be one that fills a tunnel.
enum class Candidates : u8 { tested, trusted };

struct PlanRules {
  Genus genus;
  Otherwise otherwise;
  Candidates candidates = Candidates::tested;
};

struct PieceOutcome {
  bool done = false;  // the holes of the piece are closed; and unless `trusted`, the new faces meet nothing
  bool out_of_faces = false;
  bool forced = false;   // some cap meets something
  bool trusted = false;  // a candidate was placed that was not tested, and may meet something
  u32 too_long = 0;      // vertices of the loops, where these are more than there is room for
  u32 joined = 0;        // loops that one handle joined
  u32 capped = 0;        // loops that got a cap of their own
};

// Closes the holes of one piece, after cut(): a single loop by a cap, several by a handle. Where nothing fits, or the
// piece is too long, the holes stay open and done is false.
PieceOutcome connect_piece(Edit& e, NearFaces& g, const Clusters& r, const Piece& piece,
                           const CandidateOptions& options, const PlanRules& rules, ClosingScratch& s);

}  // namespace tpa
