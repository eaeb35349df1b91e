// SPDX-License-Identifier: MIT
// merge_close: edges of an exact cut that are too short for their ends to be told apart after rounding.
#pragma once

#include "detect/near_faces.h"
#include "mesh/region_change.h"

namespace tpa {

struct MergeScratch {
  u8* face_mark;          // per face, zero before and after
  Stack<u32>& faces;      // to look at; afterwards without those that are gone
  Stack<u32>& stretched;  // afterwards: the vertices whose faces have changed; room for all of the mesh
};

// Contracts edges of the faces shorter than `reach`, towards vertices older than the transaction where there is one.
// The topology stays; contacts may arise at the stretched faces. Expected O(faces).
void merge_close(Edit& e, NearFaces& g, f64 reach, MergeScratch& scratch, RegionChange& region);

}  // namespace tpa
