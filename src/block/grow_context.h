// SPDX-License-Identifier: MIT
// grow_context: the state of a context carried into another one, with limits of its own.
#pragma once

#include "block/context.h"

namespace tpa {

// False, with the issue filled in, unless the mesh and the results of the last commit are within the limits.
bool state_fits(const Context& from, const Limits& limits, tpa_issue& issue);
// Carries the state into a context just made. Later results have the bits that they would have had. TPA_E_LIMIT for
// more components than fit. Pre: state_fits(). O(V).
tpa_status carry_state(const Context& from, Context& to, tpa_issue& issue);

}  // namespace tpa
