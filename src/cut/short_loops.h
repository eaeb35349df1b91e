// SPDX-License-Identifier: MIT
// short_loops: loops of edges round a thin handle or tunnel of the surface, near a given vertex. Such a loop bounds
// no disc, and leaves the surface in one piece. Shortest paths from the vertex make a tree; every other edge near by
// closes a loop (Erickson and Whittlesey 2005).
#pragma once

#include "base/heap.h"
#include "base/meter.h"
#include "mesh/half_edges.h"

namespace tpa {

// The most vertices of a loop, and vertices near a vertex that are looked at: the longest loop goes six edges away, and
// within six edges an even mesh has 126 others.
inline constexpr u32 longest_short_loop = 12, most_near_vertices = 128;

// Paths avoid hubs, vertices with more faces.
inline constexpr u32 most_faces_of_vertex = 48;

// The most entries of the heap of paths; beyond, longer paths may be taken.
inline constexpr u32 most_heap_entries = 8 * most_near_vertices;

// Faces beside a loop that are looked at for a way from one side to the other.
inline constexpr u32 most_faces_beside = 2048;

// Loops tried near a vertex.
inline constexpr u32 most_loops_tried = 16;

struct ShortLoopSearch {
  f64* way = nullptr;       // per vertex near by: the length of the shortest path
  u32* towards = nullptr;   // per vertex near by: the half-edge to it on that path
  u8* near = nullptr;       // per vertex; zero before and after
  u8* face_mark = nullptr;  // per face; zero before and after
  Stack<HeapEntry> heap;
  Stack<u32> vertices, faces;  // room for all of the mesh
  Meter* meter = nullptr;
};

// Half-edges of a loop, each from the head of the one before.
struct ShortLoop {
  f64 thickness = 0;  // as a share of the longest
  u32 count = 0;
  u32 half_edge[longest_short_loop];
};

// How long a loop may be: round a tunnel, if it bounds a disc outside of the surface, as a circle of the disc's area,
// and in fact; round a handle, if inside.
struct LoopLengths {
  f64 tunnel = 0, flat_tunnel = 0, handle = 0;
};

// The shortest such loop near v, but for the first `skipped` ones. Loops with new vertices of which v is not the lowest
// are left out: so no loop with new vertices is found from two vertices. O(vertices near v), and O(most_faces_beside)
// for each loop tried.
bool find_short_loop(const Mesh& m, u32 v, const LoopLengths& longest, u32 skipped, ShortLoopSearch& s,
                     ShortLoop& loop);

}  // namespace tpa
