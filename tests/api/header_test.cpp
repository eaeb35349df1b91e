// SPDX-License-Identifier: MIT
// The header from C++, included twice.
#include "topoadapt.h"

static_assert(sizeof(tpa_status) == 4 && TPA_E_TANGLED == -9);
