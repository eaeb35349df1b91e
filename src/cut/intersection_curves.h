// SPDX-License-Identifier: MIT
// intersection_curves: where two sheets of the surface cross, in a seam, the boundary of the region passes from sheet
// to sheet. Loops of a group make a piece if the boundary connects them, across all sheets and seams. Section 2 calls
// this "analysing the positions of the vertices". A tube pushed through a thin plate is to be joined to the plate on
// both sides, and not with all four loops at once.
//
// A sheet is a part of the clusters connected by edges without contact. A piercing is a point where an edge of one
// sheet passes through a face of another; along the edge, the winding number changes by one. The parts of the edge with
// winding number 0 on the outer side belong to the boundary, and so do the piercings at their ends. Adjacent sheets and
// piercings of the boundary belong to the same piece.
#pragma once

#include "cut/neck.h"

namespace tpa {

struct Piercing {
  f64 along;  // place on the edge, 0 at the tail; rounded, as it only orders the piercings of an edge
  u32 edge;   // the lower half-edge
  u32 face;
  u32 parent;  // in the disjoint sets of pieces
  i8 turn;     // +1 if the edge, from its tail, enters the solid behind the face; -1 if it leaves the solid
  bool kept;   // part of the boundary
};

// In SeamScratch::winding.
inline constexpr i8 unknown_winding = 127;

struct SeamScratch {
  u32* sheet = nullptr;       // per vertex: parent in the disjoint sets of sheets
  u32* piece = nullptr;       // per vertex: parent in the disjoint sets of pieces
  i8* winding = nullptr;      // per vertex: on the outer side of its sheet, or unknown_winding
  Stack<Piercing> piercings;  // as many as contacts
  u32* crossing = nullptr;    // OpenHash, a crossing for each two crossing faces: twice as many as contacts
  NeckScratch neck;
};

// After form_groups(): orders the loops of each group by pieces, and fills r.pieces. Several loops of a cluster come
// apart at pinches, if no other cluster has a share in their piece: a neck is cut, a hole is filled (nested objects and
// pinched necks, section 5). At mere folds they stay together. Expected O(members + contacts log contacts), and
// part_legs() for each cluster with several loops to part.
void find_pieces(const Mesh& m, const NearFaces& g, i32 winding_at_infinity, Span<const Contact> contacts, Clusters& r,
                 SeamScratch& s);

// After find_pieces(): does an edge of one face pass through the other?
bool faces_cross(const Mesh& m, const SeamScratch& s, u32 f, u32 g);

}  // namespace tpa
