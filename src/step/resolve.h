// SPDX-License-Identifier: MIT
// resolve: the steps of section 5, pass after pass until nothing meets. A pass takes the contacts at hand. It finds
// clusters, loops and pieces, cuts, closes the holes with new surfaces, and smooths.
#pragma once

#include "step/attempt.h"

namespace tpa {

// Resolves the contacts in w.detection, and all contacts of the resulting surfaces. Pre: components are known.
Outcome pass_until_clean(Attempt& a);

}  // namespace tpa
