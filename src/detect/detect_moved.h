// SPDX-License-Identifier: MIT
// detect_moved: the contacts of faces that are new or have moved (section 3), found by way of the faces near them.
// Proofs leave most pairs out; the exact test decides on the others.
#pragma once

#include "base/parallel.h"
#include "detect/contact.h"
#include "detect/near_faces.h"

namespace tpa {

// The faces to be tested, and room for notes about them.
struct DetectScope {
  u8* active;             // per face: 1 for new and moved faces, else 0; two faces with 0 are known not to meet.
                          // Afterwards any entry of 1 may hold another number, but not 0
  Span<const u32> faces;  // exactly the active faces, each once
  Span<u32> room;         // for as many faces; with less room, no groups are formed
  u8* star;               // notes of star_proven()
  TaskRooms rooms;        // one at least
};

// All contacts of active faces among the faces that NearFaces holds; if the meter stops, some are left out. Expected
// O(active faces + pairs).
void detect(const Mesh& m, const NearFaces& g, const DetectScope& scope, const Exec& exec, Detection& out);

}  // namespace tpa
