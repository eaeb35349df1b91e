// coarse_faces: where a mesh is too coarse for its contacts. Section 5 removes all vertices of faces in contact; what
// bounds the region and has no vertex besides would go with them: a component all of whose faces are in contact, since
// it is coarse or small or lies upon another; a part between two contacts; a handle, where the surface meets itself in
// creases that reach all round it. Faces are halved until such parts are kept.
#pragma once

#include "cut/intersection_curves.h"
#include "cut/union_order.h"

namespace tpa {

// How much may not be lost.
enum class Care : u8 {
  components,  // whole components that meet others
  bulk,        // nor more than a third of what is seen of them
  boundary     // nor any vertex of the boundary but those next to what stays
};

// After find_pieces(): collects in `faces`, each once, those to be halved: faces in contact that would take with them
// what may not be lost, and faces much larger than others that they meet; none round vertices that come from an old one
// that is marked as taken_along or left_coarse. `mark` has an entry for each face, zero before and after; `faces` has
// memory for one more than it takes. O(members + contacts).
void find_coarse(const Mesh& m, Span<const Contact> contacts, Care care, const u8* vertex_marks, const Clusters& r,
                 const SeamScratch& s, u8* mark, Stack<u32>& faces);

struct LostScratch {
  u8* mark = nullptr;   // per vertex, zero before and after
  Stack<u32> vertices;  // as many as the mesh can have
};

// After find_coarse(), which has described the clusters. Halving does not help where components lie upon each other. Of
// two that would lose most of what they show to a contact with each other, the one of larger volume is taken out of the
// regions and stays as it is; the other goes whole. The vertices that were to go and stay come last in r.members,
// behind members.size; returns how many they are.
// O(members + contacts), and for each cluster in contact with others as much as all members and its component.
u32 spare_largest(const Mesh& m, Span<const Contact> contacts, Care care, Clusters& r, const SeamScratch& s,
                  LostScratch& scratch);

}  // namespace tpa
