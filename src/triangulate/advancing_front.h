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
  Meter* meter = nullptr;  // where it stops, the search is given up
};

// Closes the loops. First, several loops are joined to one polygon by single faces over a loop's edge and a vertex of
// another loop, shortest first. Then faces over an edge of a polygon and another of its vertices, shortest first, part
// the polygon into smaller polygons until all are closed. Faces on the open side between different loops come first.
// The surface is a sphere with the caps of the loops, like the handles of section 4. Where no face is free, the faces
// round the open rest are taken back, and others tried.
//
// Corners of faces count the vertices of all loops, whose points lie one after another in one array. False where some
// hole is left: placed faces stay then, and `open`, with room for all vertices, has the vertices of the holes, each
// once, or none if the loops could not be joined. As a rule O(vertices log vertices) time and O(vertices) questions,
// and as much again for the open rest after each of at most 63 openings; at most O(vertices^2) for each.
bool zip(Span<const Loop> loops, Span<u8> scratch, const FacePlacer& placer, Stack<u32>& open);

}  // namespace tpa
