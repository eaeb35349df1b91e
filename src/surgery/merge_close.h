// SPDX-License-Identifier: MIT
// merge_close: edges of an exact cut that are too short for their ends to be told apart after rounding.
#pragma once

#include "detect/near_faces.h"
#include "mesh/region_change.h"

namespace tpa {

// Contracts edges of `faces` shorter than `reach`, towards vertices older than the transaction where there is one. The
// topology stays; contacts may arise. Drops faces that are gone from the list. face_mark is zero before and after.
// Expected O(faces).
void merge_close(Edit& e, NearFaces& g, f64 reach, Stack<u32>& faces, u8* face_mark, RegionChange& region);

}  // namespace tpa
