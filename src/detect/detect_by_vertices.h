// detect_by_vertices: section 3 to the letter. Vertices are hashed with cells of edge length `cell`; of the vertices of
// one slot, triangles adjacent to vertices that no path of mesh edges within the slot connects are tested.
#pragma once

#include "detect/detect_moved.h"

namespace tpa {

struct VertexHash {
  u32* head;  // an entry for each slot
  u32* slot;  // for each vertex, and so the others
  u32* link;
  u32* order;
  u32* marked;
  u8* lower;
  u32 slots;
  f64 cell;
  f64 longest_edge;  // at least; of the whole mesh
};

f64 longest_edge(const Mesh& m);

// Expected O(V).
void detect_by_vertices(const Mesh& m, const VertexHash& hash, Detection& out);

}  // namespace tpa
