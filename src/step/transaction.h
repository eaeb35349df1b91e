// SPDX-License-Identifier: MIT
// transaction: move, detect, group, cut, connect, check, commit (sections 2 and 5; docs/architecture.md). Places that
// resist all attempts are rolled back, in a growing zone, until the mesh is clean.
#pragma once

#include "step/passes.h"

namespace tpa {

// Plays attempts until the mesh is clean, and commits the result. On failure the mesh is as before, and `issue` names
// the exceeded limit.
tpa_status run_transaction(Workspace& w, Mode mode, const Exec& exec, tpa_report& report, tpa_issue& issue);

// Makes the edited mesh the mesh of the context: closes holes in its numbering, fills the maps, moves the epoch.
void publish(Workspace& w);

}  // namespace tpa
