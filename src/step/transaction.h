// SPDX-License-Identifier: MIT
// transaction: move, detect, group, cut, connect, check, commit (sections 2 and 5; docs/architecture.md). Vertices
// round a stubborn contact keep their old positions, in a zone grown until the mesh is clean.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// Plays attempts until an attempt ends clean, and commits the result. On failure the mesh is as before, and `issue`
// names the exceeded limit. tpa_adapt may commit stubborn contacts, counted in the report.
tpa_status run_transaction(Workspace& w, Mode mode, Extent extent, const Exec& exec, tpa_report& report,
                           tpa_issue& issue);

// Makes the edited mesh the mesh of the context: closes holes in the numbering, fills the maps, begins a new epoch.
void publish(Workspace& w);

// Makes the pending events those of the commit, behind `before` events of the commit's earlier parts.
void publish_events(Workspace& w, u32 before);

}  // namespace tpa
