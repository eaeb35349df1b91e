// transaction: the transaction of section 5 (docs/architecture.md): move, detect, group, cut, connect, check, commit.
// What cannot be resolved is rolled back, in a zone that grows until the mesh is clean.
#pragma once

#include "step/passes.h"

namespace tpa {

tpa_status run_transaction(Workspace& w, Mode mode, const Exec& exec, tpa_report& report, tpa_issue& issue);

// Makes the transaction's result the mesh: closes holes, publishes maps and pending events, moves the epoch.
void publish(Workspace& w);

}  // namespace tpa
