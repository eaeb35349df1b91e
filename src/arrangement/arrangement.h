// SPDX-License-Identifier: MIT
// arrangement: the faces in contact, divided so that no two pieces cross (docs/exact-cut.md). Traces are found first
// (arrangement/traces.h); each facet, the faces of a plane, is divided along its traces (arrangement/divide.h); winding
// numbers tell the pieces that bound the region (arrangement/regions.h).
#pragma once

#include "arrangement/planar_map.h"
#include "base/arena.h"

namespace tpa {

// A triangle of the divided surface. The normal points to its front; behind, the winding number is higher by `layers`.
struct CutPiece {
  u32 p[3];  // points, counter-clockwise seen from the front
  u32 face;  // a face with the same plane and normal that covers the piece
  u32 facet;
  i32 layers;   // at least 1
  i32 winding;  // in front
};

struct Arrangement {
  const Mesh* mesh = nullptr;
  ArrangementPoints points{};
  Stack<u32> faces;            // with area and in contact, ascending
  u32* facet = nullptr;        // per place in `faces`: disjoint sets of faces in one plane and in contact
  u32* facet_faces = nullptr;  // places in `faces`, facet by facet
  u32* first_trace = nullptr;  // per place in `faces`, for the facet of that name, and one more
  Stack<Trace> traces;
  u32* facet_traces = nullptr;  // numbers of traces, facet by facet
  u32* place = nullptr;         // per point: its place in the map, none outside of a facet's turn
  PlanarMap map{};
  i32* cover[2] = {};   // per triangle of the map: faces that cover it, seen from the front and from behind
  u32* origin[2] = {};  // and the lowest of these faces
  Stack<CutPiece> pieces;
  bool traced = false;  // all traces are found
  u64 wanted = 0;       // pieces that are enough, where this is known before all facets are divided
  u32 groups = 0;       // of pieces whose winding numbers depend on each other
  // Half-edge 3 i + k runs from corner k of piece i.
  OpenHash edges;         // by the two points
  u32* around = nullptr;  // per half-edge: the next of the same edge, in a ring
  u32* mate = nullptr;    // per half-edge of a kept piece: the other half-edge at the edge, or border_tag | border
  u8* reached = nullptr;  // per piece
  Stack<u32> queue;
  Stack<u32> shared;                // one half-edge for each pair of mates at an edge of more than two kept pieces
  Stack<u32> borders;               // half-edges of the mesh beyond the pieces
  VertexOrigin* origins = nullptr;  // per point
  u32* vertex = nullptr;            // per point: the vertex of the mesh
};

inline constexpr u32 border_tag = 1u << 31;

inline u32 point_at_tail(const Arrangement& a, u32 h) { return a.pieces[face_of(h)].p[index_in_face(h)]; }
inline u32 point_at_head(const Arrangement& a, u32 h) { return point_at_tail(a, next_edge(h)); }

// Does the piece bound the region of winding number >= 1?
inline bool is_kept(const CutPiece& piece) { return piece.winding <= 0 && piece.winding + piece.layers >= 1; }

// Traces that may cross more often than this for each piece of the room are counted when 1 / counting_share of the room
// is taken. The division ends there if the sum is refusal_share times the room: to fill the room would take as long as
// the room is large.
inline constexpr u64 crowded_share = 8, counting_share = 32, refusal_share = 4;

// Work that a stage of the arrangement counts; nullptr: nobody counts. Where the meter stops, the stages end, and none
// of their results is of use.
inline Meter* meter_of(const Arrangement& a) { return a.points.meter; }
inline bool has_stopped(const Arrangement& a) { return has_stopped(meter_of(a)); }

// Room for an arrangement of so many pieces.
u64 arrangement_bytes(u64 pieces);
Arrangement open_arrangement(u8* memory, u32 pieces, const Mesh& m, Meter* meter);

// The place of face f in `faces`, or none.
u32 place_of_face(const Arrangement& a, u32 f);

}  // namespace tpa
