// SPDX-License-Identifier: MIT
// carry: attributes of the caller through the maps of the last commit. Only reads the context.
#pragma once

#include "block/context.h"

namespace tpa {

// Rows of attributes, `width` numbers for each element.
template <class Number>
struct AttributeRows {
  const Number* before;
  Number* after;
  u32 width;
};
using Attributes = AttributeRows<f32>;

void carry_vertices(const Context& c, const Attributes& rows);
void carry_vertices(const Context& c, const AttributeRows<f64>& rows);
// Faces without an origin take the row of the nearest face with one, across edges; zeros where there is none. O(V), and
// O(V) for each ring of faces without an origin.
void carry_triangles(const Context& c, const Attributes& rows);

}  // namespace tpa
