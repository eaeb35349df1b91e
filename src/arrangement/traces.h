// SPDX-License-Identifier: MIT
// traces: where the faces in contact cross or touch each other, as points and segments in the planes of both.
#pragma once

#include "arrangement/arrangement.h"
#include "detect/contact.h"

namespace tpa {

// The axis along which a face shows the largest area, or `of_face` for a face without area.
u32 axis_of(const Mesh& m, u32 f);

// Collects faces, facets, points and traces of the contacts, sorted by facet. False if room runs out, or the meter
// stops. O(contacts log contacts).
bool find_traces(Arrangement& a, Span<const Contact> contacts);

}  // namespace tpa
