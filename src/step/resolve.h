// SPDX-License-Identifier: MIT
// resolve: one pass of section 5 over the contacts at hand: clusters, loops and pieces, the cut, the new surfaces,
// their smoothing; pass after pass until nothing meets.
#pragma once

#include "step/attempt.h"

namespace tpa {

// Resolves the contacts in w.detection, and all contacts of the resulting surfaces. Pre: components are known.
Outcome pass_until_clean(Attempt& a);

}  // namespace tpa
