// plan: which new surface closes the holes of a contact group (section 5, steps 5 to 7)? Handles in the order of their
// edge length, the first that is free of intersections; else caps.
#pragma once

#include "candidates.h"
#include "rewrite.h"

namespace tpa {

// Bytes of scratch that the search for candidates wants when all loops together have up to `cuts` vertices.
u64 plan_scratch_bytes(u32 cuts);

struct PlanScratch {
  Stack<u32> placed;             // faces of the plan in hand; 2 * cuts
  Span<LocalFace> faces;         // one candidate; 2 * cuts
  Span<u32> vertices, borders;   // of the loops in hand; cuts
  Span<Vec3> points;             // cuts
  Span<u8> search;               // plan_scratch_bytes(cuts)
  u64* keys = nullptr;           // 6 * cuts
  u32* edges = nullptr;          // 6 * cuts
};

struct GroupOutcome {
  bool done = false;          // the holes of the group are closed and the new faces meet nothing
  bool out_of_faces = false;
  u32 joined = 0;             // loops that one handle joined
  u32 capped = 0;             // loops that got a cap of their own
};

// Closes the holes of one group, after cut(). Where nothing fits, the holes stay open and done is false.
GroupOutcome connect_group(Edit& e, Grid& g, const Regions& r, const Group& group, const CandidateOptions& options,
                           PlanScratch& s);

}  // namespace tpa
