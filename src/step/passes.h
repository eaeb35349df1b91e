// SPDX-License-Identifier: MIT
// passes: one attempt on the moved mesh: detect, resolve pass by pass, drop components that bound nothing (section 5).
#pragma once

#include "step/attempt.h"

namespace tpa {

// Resolves all contacts of the moved mesh.
Outcome run_passes(Attempt& a);

}  // namespace tpa
