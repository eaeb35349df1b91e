// SPDX-License-Identifier: MIT
// sew_pieces: replaces the faces in contact by the pieces that bound the region, as an exact cut has decided.
#pragma once

#include "arrangement/exact_cut.h"
#include "mesh/region_change.h"

namespace tpa {

struct SewingScratch {
  u8* face_mark;         // per face: 1 for faces in contact, else zero; zero afterwards
  Stack<u32>& faces;     // faces in contact, then all faces that go, at last the new faces
  Stack<u32>& vertices;  // room for all of the mesh
  Stack<u32>& apart;     // afterwards: vertices that share their place with others
  u32 removed = 0;       // afterwards: the number of vertices that went
  u64 wanted = 0;        // out of vertices or triangles: the slots of the mesh that would be enough
};

enum class SewOutcome : u8 { success, vertices, triangles };

// Lists the faces that go besides those in contact: what lies beyond their rim within the region or inside out. Marks
// them with numbers other than zero. False for a contradiction, without marks: a kept piece lies beside such a face.
// O(pieces + faces).
bool find_swallowed_faces(const Mesh& m, const Arrangement& a, SewingScratch& scratch);

// After find_swallowed_faces(): removes the listed faces, and clears their marks; makes the kept pieces faces; gives
// each fan of faces round a point a vertex of its own. Vertices keep number and position in one of their fans. Parts of
// the region that touch in edges or points do so still: see part_touching(). Out of elements, the edit is to be rolled
// back. Expected O(pieces + faces removed).
SewOutcome sew_pieces(Edit& e, NearFaces& g, Arrangement& a, SewingScratch& scratch);

// Moves vertices that share their place apart, each towards its own surface, by a small part of its shortest edge.
// O(their faces).
void part_touching(Edit& e, Span<const u32> apart, RegionChange& region);

}  // namespace tpa
