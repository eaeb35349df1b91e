// SPDX-License-Identifier: MIT
// coarse_faces: faces to halve, as the mesh is too coarse for its contacts. Section 5 removes all vertices of faces in
// contact. Three kinds of parts of the boundary may have no other vertices: a component with all faces in contact,
// being coarse or small or upon another; a part between two contacts; a handle with creases all round. Faces are halved
// until some of each part is kept.
#pragma once

#include "cut/intersection_curves.h"

namespace tpa {

// The parts that must not be lost.
enum class Care : u8 {
  components,  // whole components that meet others
  bulk,        // nor more than a third of the visible surface round a cluster
  boundary     // nor any vertex of the boundary, but for neighbours of staying vertices
};

// Clusters::traits: a set of these, and the number of vertices of the cluster as a multiple of one_vertex.
enum ClusterTrait : u32 {
  has_loop = 1,
  bounds = 2,  // has vertices on the boundary of the region
  meets_other = 4,
  has_handle = 8,
  greedy = 16,    // takes much along, see Care::bulk
  weighed = 32,   // `greedy` is known
  at_stake = 64,  // and the next two: cut/coincident.h
  spared = 128,
  beaten = 256,
  one_vertex = 512
};

// Would the loss of a cluster with these traits lose a whole component against `care`?
bool vanishes(u32 traits, Care care);

// After find_pieces(): describes all clusters (Clusters::traits) and collects in `faces`, each once, the faces to
// halve. These are faces in contact, if parts would be lost against `care`, and faces much larger than a face in
// contact with them. Faces round a vertex from an old vertex marked taken_along or left_coarse are not halved. `mark`
// has an entry for each face, zero before and after; `faces` has room for one more than the faces of the mesh.
// O(members + contacts).
void find_coarse_faces(const Mesh& m, Span<const Contact> contacts, Care care, const u8* vertex_marks,
                       const Clusters& r, const SeamScratch& s, u8* mark, Stack<u32>& faces);

}  // namespace tpa
