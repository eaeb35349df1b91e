// zip: closing loops face by face, each of which meets nothing when it is placed. Where loops are long or many, whole
// handles in order of length that meet nothing are too rare to be come upon.
#pragma once

#include "candidates.h"

namespace tpa {

u64 zip_scratch_bytes(u64 vertices, u64 loops);

struct FacePlacer {
  // Places a face if it meets nothing that is there, and says whether it did.
  bool (*place)(void* caller, const HandleFace& face);
  // Takes one away again, by its number among those that are placed; the last one then has its number.
  void (*take_back)(void* caller, u32 number);
  void* caller;
};

// Several loops are first joined to one polygon by single faces over a loop's edge and a vertex of another loop,
// shortest first. The polygon is closed ear by ear, over the shortest chord first, those between different loops before
// others. Where no ear is free, faces round what is left are taken back, and closed in another order. Corners as in
// CandidateFace. False where some hole is left; faces have been placed then all the same. O(vertices^2) for joining
// where few loops lie side by side, and at most 64 questions for each loop; then O(vertices log vertices) and
// O(vertices) questions, and so again for each opening, of which there are at most 189.
bool zip(Span<const Loop> loops, Span<u8> scratch, const FacePlacer& placer);

}  // namespace tpa
