// SPDX-License-Identifier: MIT
// restore_state: a saved state read, checked as a whole, and then put in place of the state of a context. The checks
// need no memory but the shadow mesh.
#pragma once

#include "block/saved_state.h"

namespace tpa {

// On failure the issue is filled in, and the state of the context is as before. O(V).
tpa_status restore_state(Context& c, const u8* data, u64 size, tpa_issue& issue);

}  // namespace tpa
