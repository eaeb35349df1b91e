// collapse: contracting neighbours to one vertex, checked before it is done.
#pragma once

#include "journal.h"
#include "trial.h"

namespace tpa {

// The vertices `gone` go; `stays` moves to `to`, takes over their faces, and says that it comes from `origin`. False,
// and nothing is changed, where the mesh would not stay a manifold free of contacts, a face would turn by 60 degrees or
// more, or an edge at `stays` would be longer than the root of `most_squared_length`. `face_mark` has an entry for each
// face, zero before and after.
bool collapse(Edit& e, Grid& g, Span<const u32> gone, u32 stays, Vec3 to, VertexOrigin origin, f64 most_squared_length,
              u8* face_mark);

}  // namespace tpa
