// SPDX-License-Identifier: MIT
// shadow_mesh: a mesh beside the mesh of the context, to be read and checked before anything is replaced.
#pragma once

#include "block/context.h"

namespace tpa {

// Room for a mesh within the limits. Its memory is scratch, and the part of the journal that is free between
// transactions, apart from the list of vertices left behind.
Mesh open_shadow_mesh(const Context& c, u32 vertices, u32 faces);

// The first defect of positions and triangles; fills the rest of the shadow mesh. The known components and the near
// faces of the context are lost.
Defect check_shadow_mesh(Context& c, Mesh& shadow);
// Labels the components in the tables of the context, and returns their number, also beyond the limit. Pre: checked.
u32 label_shadow_mesh(Context& c, const Mesh& shadow);

// Puts back what the context knew of its own mesh.
void drop_shadow_mesh(Context& c);
// Makes the shadow mesh the mesh of the context, without targets and events, and with maps that are the identity. Pre:
// so many components are labelled, within the limit.
void adopt_shadow_mesh(Context& c, const Mesh& shadow, u32 components);

}  // namespace tpa
