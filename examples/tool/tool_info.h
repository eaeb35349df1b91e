// SPDX-License-Identifier: MIT
// tool_info: topoadapt segment --info.
#pragma once

#include "tool/segment/request.h"

namespace tool {

// The exit code. Writes text, and a report and a picture where asked for.
int run_info(const SegmentRequest& request, Volume& volume);

}  // namespace tool
