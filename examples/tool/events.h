// SPDX-License-Identifier: MIT
// events: changes of topology, counted for reports.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tool/json.h"
#include "topoadapt.h"

namespace tool {

// Volumes of the region of winding number 1 or more: before and after the last step in which the library measured them,
// and the sums of all steps for what was lost and gained.
struct RegionVolumes {
  double before = 0, after = 0, lost = 0, gained = 0;
  double left_out = 0;  // what parts inside out enclose, which is no part of `before`
};

struct EventCounts {
  uint64_t merge = 0, split = 0, genus_up = 0, genus_down = 0, death = 0, rollback = 0;
  uint64_t handles[4] = {0, 0, 0, 0};  // joining 2, 3, 4, more
  // For each group of contacts: the pairs of triangles at the start of its step, divided by the groups of the step.
  std::vector<double> contacts;
  RegionVolumes region;
  std::vector<std::array<double, 3>> places;  // of handles and caps

  // Adds the events of the last step.
  void add(const tpa_context* context, const tpa_report& report);
};

// The members "events", "handles" and "region" of the reports.
void describe(JsonWriter& json, const EventCounts& events);

}  // namespace tool
