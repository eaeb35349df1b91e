// volume: what components enclose, now and before the transaction, since one that is turned inside out bounds nothing.
// From step to step the volumes are kept, with bounds on their error, so that where few faces are not as they were only
// those are looked at. Who has no volume that is known well enough is measured anew.
#pragma once

#include "mesh/component_changes.h"
#include "mesh/enclosed.h"

namespace tpa {

// Of all components, now and before, each the sum over its faces in their order; before, what is known serves where it
// has the same sign. O(V).
void measure_volumes(const Edit& e, Components& components);

// Where only vertices moved: brings the volumes up to date, and proves that the signs that measure_volumes() would tell
// now and before are the same. False proves nothing. O(faces round what moved).
bool none_turned(const Edit& e, Components& components);

// After find_parts(), with the mesh as it will be committed: the volumes of the parts. O(what find_parts() looked at).
void measure_parts(const Edit& e, Components& before, Parts& p);

}  // namespace tpa
