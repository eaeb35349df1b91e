// SPDX-License-Identifier: MIT
// hold_back: vertices that an island keeps at their old positions, since its contacts have no solution otherwise.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// Before a failed attempt is taken back: notes in w.work_vertices the old vertices from which the faces in contact
// come.
void choose_at_contacts(Attempt& a);
// After that, where none is in contact: notes the corners of the faces that met at first.
void choose_at_faces(Transaction& t, Span<const IslandContact> contacts);

// Holds the noted vertices back with `rings` rings of neighbours, or with their whole components, and enters their
// faces. Returns the number of vertices newly held back. O(noted vertices, neighbours and their faces).
u32 hold_back(Transaction& t, u32 rings);

}  // namespace tpa
