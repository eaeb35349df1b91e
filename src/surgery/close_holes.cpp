// SPDX-License-Identifier: MIT
#include "surgery/close_holes.h"

#include "base/arena.h"
#include "detect/new_faces.h"

namespace tpa {

namespace {

struct Closing {
  Edit& e;
  NearFaces& g;
  const Clusters& r;
  ClosingScratch& s;
  PieceOutcome out;
};

struct FaceAsked {
  Closing& closing;
  Span<const u32> vertices;
};

// Are the faces, largest_star at most, free: none would meet the mesh or another of them?
bool are_free(const Closing& p, Span<const u32> vertices, Span<const FaceCorners> faces) {
  FaceCorners trials[largest_star];
  for (u32 i = 0; i < faces.size; ++i)
    for (u32 c = 0; c < 3; ++c) trials[i].v[c] = vertices[faces[i].v[c]];
  return trials_are_free(p.e.mesh, p.g, nullptr, trials, faces.size, Expected::bent);
}

bool face_is_free(void* caller, const FaceCorners& face) {
  const auto& [p, vertices] = *static_cast<FaceAsked*>(caller);
  return are_free(p, vertices, {&face, 1});
}

// Places a candidate; if `tested`, only a free one. One search of NearFaces serves largest_star faces.
bool place_all(Closing& p, Span<const u32> vertices, Span<const FaceCorners> faces, bool tested) {
  const u32 from = p.s.placed.size;
  for (u32 at = 0; at < faces.size; at += largest_star) {
    const Span<const FaceCorners> some = faces.part(at, min_of(largest_star, faces.size - at));
    const bool free = !tested || are_free(p, vertices, some);
    p.out.out_of_faces = free && !place(p.e, p.g, vertices, some, p.s.placed);
    if (free && !p.out.out_of_faces) continue;
    unplace(p.e, p.g, p.s.placed, from);
    return false;
  }
  return true;
}

// Collects the loops' vertices, and makes polygons. Returns the number of vertices.
u32 collect_loops(Closing& p, Span<const CutLoop> loops) {
  u32 n = 0;
  for (u32 i = 0; i < loops.size; ++i) {
    p.s.polygons[i] = {p.s.points.data + n, loops[i].count};
    for (u32 k = 0; k < loops[i].count; ++k, ++n) {
      const Cut& c = p.r.cuts[loops[i].first + k];
      p.s.vertices[n] = c.vertex;
      p.s.borders[n] = c.border;
      p.s.points[n] = p.e.mesh.position[c.vertex];
    }
  }
  return n;
}

// Places the first candidate across the polygons or, if `tested`, the first free candidate.
bool place_first(Closing& p, Span<const Loop> polygons, Span<const u32> vertices, const CandidateOptions& options,
                 bool tested) {
  const u32 most_faces = candidate_face_count(polygons);
  Carver carver{p.s.search.data, element_alignment};
  Span<FaceCorners> candidate;
  carver.take(candidate, most_faces);
  const u32 taken = static_cast<u32>(carver.bytes);
  CandidateSearch search;
  if (!begin(search, polygons, p.s.search.part(taken, p.s.search.size - taken), options)) return false;
  u32 faces = 0;
  while (!p.out.out_of_faces && next(search, candidate, faces))
    if (place_all(p, vertices, {candidate.data, faces}, tested)) return true;
  return false;
}

}  // namespace

u64 closing_scratch_bytes(u32 vertices) {
  constexpr u64 first_of_loops = most_loops_joined * sizeof(u32);
  const u64 candidate = 2 * u64{vertices} * sizeof(FaceCorners);  // a loop has three vertices at least
  return candidate + candidate_scratch_bytes(vertices, 2) + first_of_loops;
}

namespace {

u64 vertices_of(const Clusters& r, const Piece& piece) {
  u64 vertices = 0;
  for (const CutLoop& loop : r.loops.span().part(piece.first_loop, piece.loops)) vertices += loop.count;
  return vertices;
}

}  // namespace

bool can_be_closed(const Clusters& r, const Piece& piece) { return has_candidates(vertices_of(r, piece), piece.loops); }

u64 room_to_close(const Clusters& r, const Piece& piece) {
  return vertices_of(r, piece) + (piece.loops > 2 ? 2 * u64{piece.loops} - 4 : 0);
}

PieceOutcome connect_piece(Edit& e, NearFaces& g, const Clusters& r, const Piece& piece,
                           const CandidateOptions& options, Candidates candidates, ClosingScratch& s) {
  Closing p{e, g, r, s, {}};
  s.placed.clear();
  const bool tested = piece.loops == 1 || candidates == Candidates::tested;
  const u32 n = collect_loops(p, r.loops.span().part(piece.first_loop, piece.loops));
  const Span<const u32> vertices = s.vertices.part(0, n);
  FaceAsked asked{p, vertices};
  CandidateOptions best = options, free = options;
  best.max_candidates = 1;
  free.filter = {face_is_free, &asked};
  best.meter = free.meter = g.meter;
  const auto placed = [&](const CandidateOptions& of, bool test) {
    return place_first(p, s.polygons.part(0, piece.loops), vertices, of, test);
  };
  // With one or two loops the best candidate is tried first, unfiltered: mostly the candidate is free, and one search
  // proves all of its faces free. Otherwise candidates are made of free faces only.
  const bool first = (!tested || piece.loops <= 2) && placed(best, tested);
  p.out.trusted = first && !tested;
  p.out.done = first || placed(free, true);
  if (p.out.done) sew(e, s.placed.span(), s.borders.part(0, n), s.sewing);
  return p.out;
}

}  // namespace tpa
