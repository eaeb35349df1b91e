// detect_all: all contacts of a mesh (section 3), cluster by cluster. What a cluster is proven not to meet is passed
// over; of the rest, each face is tested against those whose boxes it meets.
#pragma once

#include "base/parallel.h"
#include "detect/contact.h"
#include "detect/face_tree.h"

namespace tpa {

// Arranges the mesh, which has no holes in its numbering, and finds its contacts. `active` marks the faces that are
// new or have moved; pairs of two others are known not to meet. nullptr: all are active. `star` has an entry for each
// vertex, zero before and after. Expected O(V + pairs).
void detect_complete(const Mesh& m, FaceTree& c, const u8* active, u8* star, const Exec& exec, Detection& out);

}  // namespace tpa
