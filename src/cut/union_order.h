// SPDX-License-Identifier: MIT
// union_order: colliding components are united one after another. Where three or more meet in a point, seams branch,
// and a piece has as many loops as components; with two at a time most pieces have two loops.
#pragma once

#include "detect/contact.h"
#include "mesh/components.h"

namespace tpa {

// After find_components(), before any event has changed the mesh: marks the components that wait, and returns whether
// there are any. Components that enclose space (cavities) do not wait, nor do components connected with cavities by
// contacts. The winding number counts how often a place is covered, and a union that closed a cavity over a waiting
// component could not be undone. Components in contact with no other do not wait either. `queue` has room for all
// vertices; `mark`, per vertex, is zero before and after.
bool choose_waiting(const Mesh& m, Span<const Contact> contacts, Components& c, u8* mark, Stack<u32>& queue);

}  // namespace tpa
