// SPDX-License-Identifier: MIT
// issue: the report of an exceeded limit, and of damaged data.
#pragma once

#include "base/base.h"
#include "topoadapt.h"

namespace tpa {

// Fills an issue of TPA_E_LIMIT and returns its status. `limit`: TPA_LIMIT_...
inline tpa_status fail_limit(tpa_issue& issue, i32 limit, u64 needed, u64 available) {
  issue = {};
  issue.status = TPA_E_LIMIT;
  issue.limit = limit;
  issue.needed = needed;
  issue.available = available;
  return TPA_E_LIMIT;
}

// Likewise of TPA_E_DATA, with the offset of the first byte at fault.
inline tpa_status fail_data(tpa_issue& issue, u64 offset, u64 needed, u64 available) {
  issue = {};
  issue.status = TPA_E_DATA;
  issue.element = offset;
  issue.needed = needed;
  issue.available = available;
  return TPA_E_DATA;
}

}  // namespace tpa
