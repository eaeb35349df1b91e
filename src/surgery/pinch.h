// SPDX-License-Identifier: MIT
// pinch: cuts the surface along a loop of edges, and caps both sides (section 2, figure 7). Both copies of the loop
// move apart by a thousandth of an edge. Of a tunnel two hollows are left, of a thin handle two stumps; the region
// hardly changes.
#pragma once

#include "cut/short_loops.h"
#include "mesh/region_change.h"
#include "surgery/close_holes.h"

namespace tpa {

enum class PinchOutcome : u8 {
  done,
  blocked,  // copies or caps would meet something: the mesh is as it was
  vertices,
  triangles  // too few are free
};

// Pre: no clusters. `face_mark`, per face, is zero before and after. O(faces at the loop + caps).
PinchOutcome pinch(Edit& e, NearFaces& g, const ShortLoop& loop, Clusters& r, ClosingScratch& closing,
                   const CandidateOptions& options, u8* face_mark, RegionChange& region);

}  // namespace tpa
