// collapse: contracting an edge to one vertex, checked before it is done.
#pragma once

#include "detect/new_faces.h"
#include "mesh/enclosed.h"
#include "mesh/journal.h"

namespace tpa {

// Vertex `goes` becomes one with `stays`, which moves to `to`, within the range of exact arithmetic, takes over its
// faces and says that it comes from `origin`. False, and nothing is changed, where the mesh would not stay a manifold
// free of contacts, a face would turn by 60 degrees or more, a tetrahedron would be left that is flat or, compared to
// what it was, inside out, or an edge at `stays` would be longer than the root of `most_squared_length`. What faces
// would meet in between does not matter. `expected`: of the surface there. `face_mark` has an entry for each face, zero
// before and after. Where `enclosed` is given, which are components that were measured, none is turned inside out, and
// what they enclose is followed.
bool collapse(Edit& e, NearFaces& g, u32 goes, u32 stays, const Vec3& to, const VertexOrigin& origin,
              f64 most_squared_length, Expected expected, u8* face_mark, Components* enclosed = nullptr);

}  // namespace tpa
