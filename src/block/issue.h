// SPDX-License-Identifier: MIT
// issue: the report of an exceeded limit, of work that ended early, and of damaged data.
#pragma once

#include "base/meter.h"
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

// Likewise of TPA_E_BUDGET or TPA_E_CANCELLED. Pre: the meter has stopped.
inline tpa_status fail_stopped(tpa_issue& issue, const Meter& meter) {
  issue = {};
  if (meter.stop == Stop::cancelled) return issue.status = TPA_E_CANCELLED;
  // The failed call has edited the face tree, so the same call may look at some leaves more.
  issue.needed = meter.needed == 0 ? 0 : meter.needed + meter.needed / 8 + 64;
  issue.available = meter.budget;
  return issue.status = TPA_E_BUDGET;
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
