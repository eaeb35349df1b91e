// SPDX-License-Identifier: MIT
// exact_cut: the surface divided where it crosses or touches itself, and the part of it that bounds the region
// (docs/exact-cut.md). Decides only; surgery/sew_pieces.h edits the mesh.
#pragma once

#include "arrangement/arrangement.h"
#include "detect/contact.h"
#include "detect/near_faces.h"

namespace tpa {

enum class CutOutcome : u8 {
  success,
  room,           // more pieces are needed
  contradiction,  // never expected; the mesh is as it was
  stopped         // the meter has stopped
};

// Divides the faces in contact, finds the winding numbers of all pieces, and pairs the edges of the kept ones: at each
// edge, the two pieces on both sides of a wedge of the region are neighbours. So parts of the region that touch in an
// edge come apart. `face_mark`, per face, is 1 for faces in contact. Pre: g holds all faces.
// O(contacts log contacts + pieces log pieces + faces along a ray for each connected group of pieces).
CutOutcome cut_exactly(Arrangement& a, Span<const Contact> contacts, const u8* face_mark, const NearFaces& g,
                       i32 winding_at_infinity);

}  // namespace tpa
