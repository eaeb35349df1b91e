// SPDX-License-Identifier: MIT
// pinch: cuts the surface along a loop of edges, and caps both sides (section 2, figure 7). Both copies of the loop
// move apart by an eighth of an edge at most. Of a tunnel two hollows are left, of a thin handle two stumps. The region
// changes by the volumes of these moves, and by the volume between the caps.
#pragma once

#include "cut/short_loops.h"
#include "mesh/region_change.h"
#include "surgery/close_holes.h"

namespace tpa {

enum class PinchOutcome : u8 {
  done,
  blocked,  // copies or caps would meet something: the mesh is as it was
  dear,     // the region would change too much: the mesh is as it was
  vertices,
  triangles  // too few are free
};

// Changes the region by `most`, six times a volume, at most. Pre: no clusters, but room for two loops; Clusters::middle
// holds places meanwhile. `face_mark`, per face, is zero before
// and after. O(faces at the loop + caps).
PinchOutcome pinch(Edit& e, NearFaces& g, const ShortLoop& loop, Clusters& r, ClosingScratch& closing,
                   const CandidateOptions& options, u8* face_mark, f64 most, RegionChange& region);

}  // namespace tpa
