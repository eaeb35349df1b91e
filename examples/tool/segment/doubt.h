// SPDX-License-Identifier: MIT
// doubt: contacts that the noise of an image may have made. Noise differs from voxel to voxel, so that the tunnels it
// makes are some voxels wide; a front that comes round a whole part of the object is another matter.
#pragma once

#include "tool/segment/balloon_state.h"

namespace tool {

// Looks at the handles of a step that has raised the genus, from `b.mesh` towards `b.x`. A handle is in doubt where the
// grey value is as near to the threshold as noise comes, and where the surface round the contact hangs together within
// a few voxels. Anchors the vertices there, at their places before the step. Returns whether any were to move: then the
// step is to be taken anew, without them.
bool hold_doubtful_contacts(Balloon& b);

}  // namespace tool
