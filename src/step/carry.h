// SPDX-License-Identifier: MIT
// carry: attributes of the caller through the maps of the last commit. Only reads the context.
#pragma once

#include "step/context.h"

namespace tpa {

// Rows of attributes, `floats` for each element.
struct Attributes {
  const f32* before;
  f32* after;
  u32 floats;
};

void carry_vertices(const Context& c, const Attributes& rows);
// Faces without an origin take the row of the nearest face with one, across edges; zeros where there is none. O(V), and
// O(V) for each ring of faces without an origin.
void carry_faces(const Context& c, const Attributes& rows);

}  // namespace tpa
