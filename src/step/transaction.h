// transaction: move, detect, group, cut, connect, check, commit (sections 2 and 5; docs/architecture.md). Places that
// resist all attempts are rolled back, in a zone that grows until the mesh is clean.
#pragma once

#include "step/passes.h"

namespace tpa {

// Plays attempts until one leaves the mesh clean, and commits it. On failure the mesh is as before, and `issue` tells
// the limit that was reached.
tpa_status run_transaction(Workspace& w, Mode mode, const Exec& exec, tpa_report& report, tpa_issue& issue);

// Makes the edited mesh the mesh of the context: closes holes in its numbering, fills the maps, moves the epoch.
void publish(Workspace& w);

}  // namespace tpa
