// bisect: halving faces, along Rivara's longest edges (Rivara 1997), so that they stay as well shaped as they are.
#pragma once

#include "detect/near_faces.h"
#include "mesh/journal.h"

namespace tpa {

// Puts v, which has no edges yet, on the half-edge h and cuts the two faces at it in two. False where faces run out;
// nothing is changed then.
bool split_edge(Edit& e, NearFaces& g, u32 h, u32 v);

inline f64 squared_edge(const Mesh& m, u32 h) {
  return squared_length(m.position[head(m, h)] - m.position[tail(m, h)]);
}

// From h on to ever longer edges of the neighbouring faces, to one that is the longest in both of its faces. Only such
// edges are split: halving others would make long thin faces out of long thin faces, without end.
u32 locally_longest(const Mesh& m, u32 h);

// Halves each of the faces, and what has to be halved with them. `mark` has an entry for each face, zero before and
// after. New vertices go to new_vertices, which holds as many as the mesh. False where vertices or faces run out.
bool halve(Edit& e, NearFaces& g, Span<const u32> faces, u8* mark, Stack<u32>& new_vertices);

}  // namespace tpa
