// SPDX-License-Identifier: MIT
// unsettled: the faces at which a sweep of remeshing may do anything. Whether an edge is too long or better flipped
// depends on its two faces; whether a collapse or flip makes a bad surface, on the faces at their corners. So a sweep
// tries edges near changes since the last sweep, and edges for which something further away was in the way. All others
// would stay as they are: the result is that of a sweep over all faces, and lost knowledge costs nothing but time.
#pragma once

#include "base/bit_set.h"
#include "mesh/half_edges.h"

namespace tpa {

struct Unsettled {
  BitSet vertices, faces;  // changed in commits since the last sweep
  BitSet lengths, flips;   // faces whose edges are to be tried for their lengths, and for flips
  BitSet lengths_before, flips_before;
};

// After a commit that changed these vertices and faces. O(members).
void note_changed(Unsettled& u, const BitSet& vertices, const BitSet& faces);
// At the start of a sweep: unsettles what is near changes, and forgets these. `list` has room for all faces.
// O(changes).
void spread(Unsettled& u, const Mesh& m, Stack<u32>& list);

// After spread(): what a call that fails has to put back. O(n / 32) for n faces of a full mesh.
void keep(Unsettled& u);
void take_back(Unsettled& u);

void unsettle_all(Unsettled& u, const Mesh& m);
// Only the faces at these vertices are to be tried for lengths. O(faces tried before and after).
void unsettle_part(Unsettled& u, const Mesh& m, Span<const u32> vertices);
// After keep(): leaves the faces away from a part to later calls, as they were. `chosen`: 1 for each vertex of the
// part, and for those made of it. O(faces at the part + faces to be tried before).
void set_flips_aside(Unsettled& u, const Mesh& m, Span<const u32> part);
void take_flips_up(Unsettled& u, const Mesh& m, const u8* chosen);
// The faces at the corners of a face.
void unsettle_round(Unsettled& u, const Mesh& m, u32 f);
// The faces at the corners of the faces of v, which has moved or has other faces now.
void unsettle_star(Unsettled& u, const Mesh& m, u32 v);
void unsettle_stars(Unsettled& u, const Mesh& m, Span<const u32> vertices);

}  // namespace tpa
