// SPDX-License-Identifier: MIT
// collapse: contracting an edge to a vertex. All conditions are checked before the mesh changes. Remeshing collapses
// short edges (section 7), and steps take back their local refinement.
#pragma once

#include "detect/new_faces.h"
#include "mesh/component_volumes.h"
#include "mesh/journal.h"

namespace tpa {

// Vertex `goes` merges into `stays`, which takes over the faces, moves to `to`, within the range of exact arithmetic,
// and gets the origin `origin`. `expected` describes the surface around. `face_mark`, per face, is zero before and
// after. If `measured` is given, components with known volumes, the volumes are followed. Contacts during the move do
// not count. Returns false, and changes nothing, if
// - the mesh would be no manifold any more, or not free of contacts,
// - a face would turn by 60 degrees or more,
// - a tetrahedron would be left flat or, compared to its volume before, inside out,
// - an edge at `stays` would be longer than the root of `most_squared_length`,
// - `measured` is given, and a component would perhaps be turned inside out.
bool collapse(Edit& e, NearFaces& near, u32 goes, u32 stays, const Vec3& to, const VertexOrigin& origin,
              f64 most_squared_length, Expected expected, u8* face_mark, Components* measured = nullptr);

// The same without a question about contacts, angles or volumes: `stays` keeps its place, and only the topology must
// stay as it is. False if it would not.
bool contract_edge(Edit& e, NearFaces& near, u32 goes, u32 stays, u8* face_mark);

}  // namespace tpa
