// coarse_faces: faces to halve, as the mesh is too coarse for its contacts. Section 5 removes all vertices of faces in
// contact, and with them any part of the boundary without a vertex besides: a component with all faces in contact,
// being coarse or small or upon another; a part between two contacts; a handle, if the surface meets itself in creases
// all round. Faces are halved until such parts are kept.
#pragma once

#include "cut/intersection_curves.h"

namespace tpa {

// What must not be lost.
enum class Care : u8 {
  components,  // whole components that meet others
  bulk,        // nor more than a third of the visible surface round a cluster
  boundary     // nor any vertex of the boundary, but for neighbours of what stays
};

// Clusters::traits: a set of these, and the number of vertices of the cluster as a multiple of one_vertex.
enum ClusterTrait : u32 {
  has_loop = 1,
  bounds = 2,  // has vertices on the boundary of the region
  meets_other = 4,
  has_handle = 8,
  greedy = 16,    // takes much with it, see Care::bulk
  weighed = 32,   // `greedy` is known
  at_stake = 64,  // this trait and the next two: cut/coincident.h
  spared = 128,
  beaten = 256,
  one_vertex = 512
};

// Would a cluster with these traits take a whole component with it that must not be lost?
bool vanishes(u32 traits, Care care);

// After find_pieces(): describes all clusters (Clusters::traits) and collects in `faces`, each once, the faces to
// halve: faces in contact that would take with them what must not be lost, and faces much larger than others that they
// meet; none round vertices that come from an old vertex marked taken_along or left_coarse. `mark` has an entry for
// each face, zero before and after; `faces` has room for one more than the faces of the mesh. O(members + contacts).
void find_coarse(const Mesh& m, Span<const Contact> contacts, Care care, const u8* vertex_marks, const Clusters& r,
                 const SeamScratch& s, u8* mark, Stack<u32>& faces);

}  // namespace tpa
