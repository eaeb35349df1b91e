// collapse: contracting an edge to a vertex, checked before it is done.
#pragma once

#include "journal.h"
#include "trial.h"

namespace tpa {

// The tail of h goes; its head moves to `to`, takes over the tail's faces, and says that it comes from `origin`. False,
// and nothing is changed, where the mesh would not stay a manifold free of contacts, a face would turn by 60 degrees or
// more, or an edge at the head would be longer than the root of `most_squared_length`. `face_mark` has an entry for
// each face, zero before and after.
bool collapse(Edit& e, Grid& g, u32 h, Vec3 to, VertexOrigin origin, f64 most_squared_length, u8* face_mark);

}  // namespace tpa
