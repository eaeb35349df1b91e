// zip: closing loops face by face, each of which meets nothing when it is placed. Where loops are long or many, whole
// handles in order of length that meet nothing are too rare to be come upon.
#pragma once

#include "candidates.h"
#include "disc.h"

namespace tpa {

u64 zip_scratch_bytes(u64 vertices, u64 loops);

// Places a face if it meets nothing that is there, and says whether it did.
struct FacePlacer {
  bool (*place)(void* caller, const HandleFace& face);
  void* caller;
};

// Several loops are first joined to one polygon by single faces over a loop's edge and a vertex of another loop, shortest
// first. The polygon is closed ear by ear, of least weight first, those between different loops before others. Corners
// as in CandidateFace. False where some hole is left; faces have been placed then all the same.
// O(vertices^2 * loops) and as many questions at most.
bool zip(Span<const Loop> loops, DiscWeight weight, Span<u8> scratch, const FacePlacer& placer);

}  // namespace tpa
