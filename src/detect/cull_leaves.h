// SPDX-License-Identifier: MIT
// cull_leaves: proofs that the faces of a leaf, or of several leaves, meet nothing of the surface around them.
//
// Let P be the leaves to be proven, seen along a direction d. Let D be a disc across d, so large that its cylinder
// along d holds all faces of P. A face in or partly in the cylinder lies over D. Let S, the neighbourhood, be P and all
// leaves reached from P over common edges by way of leaves that may lie over D. Suppose two conditions:
//
// (1) All faces of S over D turn the same side up: their normals have positive components along d.
//
// (2) Over some point inside D lies a single face of S, a face of P; no other face of S lies close to the point.
//
// Then no face of P meets a face of S except in common vertices and edges.
//
// Proof. An edge of S over D belongs to two faces over D, hence both in S. So no border of S runs over D, nor over a
// narrow margin of D. By (1) the number of faces over a point, off all edges, is the winding number of the border of S,
// constant off the border. By (2) the number is 1, since P covers part of D. Two faces with a common point in space,
// not of a common vertex or edge, would both cover points close to it, with the faces next to them. All faces with a
// vertex in common with P are in S, since they lie over D and follow each other round the vertex.
//
// Leaves outside S are compared with P face by face, if their boxes meet (detect/detect_all.cpp).
#pragma once

#include "detect/face_tree.h"

namespace tpa {

// The set S while it grows: all leaves looked at, and the leaves of S among them.
struct Neighbourhood {
  static constexpr u32 most = 160;
  LeafSet<most, 512> known;
  u32 count = 0;
  u32 member[most + 1];    // leaves of S; the last entry is spare, since take() writes before it counts
  bool belongs[most + 4];  // by place in `known`: is the leaf in S? take() may write three entries beyond `most`

  bool has(u32 leaf) const {
    const u8 at = known.place[known.slot_of(leaf)];
    return at != 0 && belongs[at - 1];
  }
  void clear() {
    known.clear();
    count = 0;
    memset(belongs, 0, sizeof belongs);
  }
  // Notes a leaf as known; false without room.
  bool note(u32 leaf) { return known.add(leaf); }
  // Takes the leaf at place `at` of `known` into S if is_in is 1, or leaves the leaf out if is_in is 0; no branch,
  // since no processor predicts the answer. With is_in 0 the place may be up to three beyond all known leaves.
  void take(u32 at, u32 leaf, u32 is_in) {
    belongs[at] = is_in != 0;
    member[count] = leaf;
    count += is_in;
  }
};

// Finds S for P a single leaf; false without a proof. O(leaves over D and adjacent leaves), at most 160 leaves.
bool find_neighbourhood(const FaceTree& tree, const Mesh& m, u32 leaf, Neighbourhood& found);
// Finds S for several leaves P at once; false without a proof. Cheaper on a surface with little bending: leaves are
// judged as wholes, and the first leaf with a face that may lean ends the search. Pre: `several` is not empty.
bool find_common_neighbourhood(const FaceTree& tree, const Mesh& m, Span<const u32> several, Neighbourhood& found);

}  // namespace tpa
