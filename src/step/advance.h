// SPDX-License-Identifier: MIT
// advance: a move in sub-steps, each a step of its own, as one call (section 2; docs/architecture.md). Parts of the
// object could pass through each other in one long step; in short sub-steps they meet.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// Takes vertices to their targets. Points of the surface approach each other by less than `thickness` in a sub-step. On
// failure all is as before. Pre: the mesh is free of contacts. As many sub-steps as the report says, O(V) besides each.
tpa_status run_advance(Context& c, f64 thickness, const Exec& exec, tpa_report& report, tpa_issue& issue);

}  // namespace tpa
