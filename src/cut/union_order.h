// union_order: uniting components that collide one after another. Where three or more of them meet in a point, seams
// branch, and a piece has as many loops as components; of two at a time most pieces have two loops.
#pragma once

#include "detect/detect_moved.h"
#include "mesh/components.h"

namespace tpa {

// After find_components() on a mesh that no event has changed yet: marks the components that wait, and returns whether
// there are any. Those that enclose space (cavities), and what hangs together with them by contacts, do not wait: the
// winding number counts how often a place is covered, and a union that closed a cavity over it could not be undone. Nor
// does what is in contact with no other component. `queue` has room for all vertices; `mark`, per vertex, is zero
// before and after.
bool choose_waiting(const Mesh& m, Span<const Contact> contacts, Components& c, u8* mark, Stack<u32>& queue);

}  // namespace tpa
