// SPDX-License-Identifier: MIT
// detect_all: all contacts of a mesh (section 3), leaf by leaf. Proofs pass over the leaves around a leaf
// (detect/cull_leaves.h). Faces of other leaves nearby are tested against the faces of the leaf whose boxes they meet.
// (The paper's hash of vertices is in detect/detect_by_vertices.h.)
#pragma once

#include "base/parallel.h"
#include "detect/contact.h"
#include "detect/face_tree.h"

namespace tpa {

// Arranges all faces in `tree`, and finds their contacts. `active` marks new and moved faces: pairs of other faces are
// known not to meet. nullptr: all faces are active. `star` has an entry for each vertex, zero before and after. Pre:
// the numbering of the mesh has no holes; a room at least. If the meter stops, some pairs are left out. Expected O(V +
// pairs).
void detect_complete(const Mesh& m, FaceTree& tree, const u8* active, u8* star, const TaskRooms& rooms,
                     const Exec& exec, Detection& out);

}  // namespace tpa
