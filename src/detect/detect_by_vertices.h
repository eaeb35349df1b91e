// SPDX-License-Identifier: MIT
// detect_by_vertices: section 3, cell by cell. A first pass maps each vertex to a slot by the hash function of equation
// (1). A second pass gathers the vertices of each slot to connected components, and intersects the triangles adjacent
// to vertices of different components. Only vertices of one cell count as neighbours in a slot, so the number of slots
// does not matter.
#pragma once

#include "base/meter.h"
#include "detect/contact.h"
#include "mesh/half_edges.h"

namespace tpa {

// What to detect with: scratch memory, and the parameters of equation (1).
struct VertexHash {
  u32* head;    // per slot: a list of vertices
  u32* slot;    // per vertex, as all below
  u32* link;    // the next vertex of the list
  u32* order;   // vertices in the order of entry; in the second pass the disjoint sets of slots
  u32* marked;  // slots for the second pass
  u8* lower;
  u32 slots;         // m of equation (1)
  f64 cell;          // l of equation (1)
  f64 longest_edge;  // at least as long as each edge of the mesh
  Meter* meter = nullptr;
};

// A little more than the length of the longest edge. O(V).
f64 longest_edge(const Mesh& m);

// Misses pairs of faces without a common cell. The numbering of the mesh may have holes. Expected O(V) for cells about
// as long as edges; O(n^2) in the vertices of one cell, and in the triangles round two of them. If the meter stops,
// some pairs are left out.
void detect_by_vertices(const Mesh& m, const VertexHash& hash, Detection& out);

}  // namespace tpa
