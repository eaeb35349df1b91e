// SPDX-License-Identifier: MIT
// advancing_front: closes loops face by face; each face meets nothing when it is placed (paper section 5, steps 5 to
// 7). Where loops are long or many, whole handles without intersections are too rare to be found among the shortest.
#pragma once

#include "triangulate/candidates.h"

namespace tpa {

u64 zip_scratch_bytes(u64 vertices);

struct FacePlacer {
  // Places a face if it meets nothing; true if placed.
  bool (*place)(void* caller, const FaceCorners& face);
  // Takes a placed face away again, by its number among the placed faces; the last face gets this number.
  void (*take_back)(void* caller, u32 number);
  void* caller;
};

// How many handles the new surface may have itself.
enum class Genus : u8 {
  zero,  // none: a sphere with the caps of the loops, like the handles of section 4
  any
};

// Between which parts of loops faces close first.
enum class Along : u8 {
  others,  // between loops that run along each other
  all      // and within a loop that runs along itself, as in the creases of a sheet that folds onto itself
};

// Closes the loops. First, several loops are joined to one polygon by single faces over a loop's edge and a vertex of
// another loop, shortest first. Then faces over an edge of a polygon and another of its vertices, shortest first, part
// the polygon into smaller polygons until all are closed. Faces on the open side between different loops come first;
// with Along::all also faces between near parts of one loop that are far apart along the loop. So loops close wherever
// they run along each other, before the wider places between several loops. Two polygons that hang together may go
// round along each other, as at a tunnel between two bodies: a ring of faces joins both, if any genus is allowed and
// the ring has less area than two discs. Where no face is free, the faces round the open rest are taken back, and
// others tried.
//
// Corners of faces count the vertices of all loops, whose points lie one after another in one array. False where some
// hole is left: placed faces stay then, and `open`, with room for all vertices, has the vertices of the holes, each
// once, or none if the loops could not be joined. As a rule O(vertices log vertices) time and O(vertices) questions,
// and as much again for the open rest after each of at most 63 openings; at most O(vertices^2) for each.
bool zip(Span<const Loop> loops, Span<u8> scratch, Genus genus, Along along, const FacePlacer& placer,
         Stack<u32>& open);

}  // namespace tpa
