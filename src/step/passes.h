// passes: detect, group, cut, connect, smooth, again and again until nothing meets (section 5).
#pragma once

#include "step/attempt.h"

namespace tpa {

// The mesh as it is: all contacts, into w.detection. The near_faces stands afterwards.
void detect_all(Workspace& w, const Exec& exec);

// On the mesh with its vertices moved: resolves all contacts; adapt may leave some at last (a.tangled).
Outcome run_passes(Attempt& a);

}  // namespace tpa
