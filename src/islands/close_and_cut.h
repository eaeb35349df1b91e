// SPDX-License-Identifier: MIT
// close_and_cut: passes of the exact cut. Each pass cuts the surface where it crosses or touches itself, and keeps what
// bounds the region. Rounding may leave contacts, far smaller than the faces; the next pass cuts there again.
#pragma once

#include "islands/attempt.h"

namespace tpa {

// Resolves the contacts in w.detection. Blocked where contacts stay after the last pass.
Outcome close_and_cut(Attempt& a);

}  // namespace tpa
