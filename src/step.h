// step: the transaction of section 5 (design 4.6): move, detect, group, cut, connect, check, commit. What cannot be
// resolved is rolled back, in a zone that grows until the mesh is clean.
#pragma once

#include "state.h"

namespace tpa {

enum class Mode : u8 {
  step,  // vertices move to their targets from a mesh free of contacts; afterwards it is free of contacts
  adapt  // the mesh may be tangled; contacts that cannot be resolved stay
};

tpa_status run_transaction(Workspace& w, Mode mode, const Exec& exec, tpa_report& report, tpa_issue& issue);

// The mesh as it is: all contacts, into w.detection. Builds the grid.
void detect_all(Workspace& w, const Exec& exec);

// Makes the transaction's result the mesh: closes holes, publishes maps and pending events, moves the epoch.
void publish(Workspace& w);

// Fills an issue and returns its status.
tpa_status fail_limit(tpa_issue& issue, i32 limit, u64 needed, u64 available);

}  // namespace tpa
