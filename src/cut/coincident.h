// SPDX-License-Identifier: MIT
// coincident: of components that lie upon each other, the largest stays. Section 5 would remove both, as all of their
// faces are in contact, and halving faces does not help.
#pragma once

#include "cut/coarse_faces.h"

namespace tpa {

struct SparingScratch {
  u8* mark = nullptr;   // per vertex, zero before and after
  Stack<u32> vertices;  // room for all vertices of the mesh
};

// After find_coarse_faces(). Two components may both lose most of their visible surface to a contact with each other.
// Then the component of larger volume leaves the clusters and stays as before; the other goes whole. The vertices that
// leave the clusters come last in r.members, behind members.size; returns their number. O(members + contacts), and for
// each cluster in contact with others as much as all members and its component.
u32 spare_largest(const Mesh& m, Span<const Contact> contacts, Care care, Clusters& r, const SeamScratch& s,
                  SparingScratch& scratch);

}  // namespace tpa
