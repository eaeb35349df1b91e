// SPDX-License-Identifier: MIT
// collapse: contracting an edge to a vertex. All conditions are checked before the mesh changes. Remeshing collapses
// short edges (section 7), and steps take back their local refinement.
#pragma once

#include "detect/new_faces.h"
#include "edit/edge_aims.h"
#include "mesh/component_volumes.h"
#include "mesh/journal.h"

namespace tpa {

// Vertex `goes` merges into `stays`, which takes over the faces, moves to `to`, within the range of exact arithmetic,
// and gets the origin `origin`. `expected` describes the surface around. `face_mark`, per face, is zero before and
// after. Contacts during the move do not count. False, and nothing changes, if
// - the mesh would be no manifold any more, or not free of contacts; faces that lie as before are not asked,
// - a face would turn by 60 degrees or more,
// - a tetrahedron would be left flat or, compared to its volume before, inside out.
bool collapse(Edit& e, NearFaces& near, u32 goes, u32 stays, const Vec3& to, const VertexOrigin& origin,
              Expected expected, u8* face_mark);

// The same for remeshing, to the place where the volume stays; to the middle of the edge where its faces are folded,
// and beside hubs. The volumes are followed. Also refused if
// - an edge at `stays`, with the mean of both aims, would be too long,
// - a component would perhaps be turned inside out.
enum class Collapse : u8 {
  done,
  barred,  // whatever else changes, as long as the faces round both vertices and their neighbours stay
  refused  // perhaps not for good
};
Collapse collapse_short_edge(Edit& e, NearFaces& near, u32 goes, u32 stays, const EdgeAims& aims, u8* face_mark,
                             VolumesOnDemand& volumes);

// collapse() without a question about contacts, angles or volumes: `stays` keeps its place, and only the topology must
// stay as it is. False if it would not.
bool contract_edge(Edit& e, NearFaces& near, u32 goes, u32 stays, u8* face_mark);

}  // namespace tpa
