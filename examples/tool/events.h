// SPDX-License-Identifier: MIT
// events: changes of topology, counted for reports.
#pragma once

#include <cstdint>
#include <vector>

#include "tool/json.h"
#include "topoadapt.h"

namespace tool {

struct EventCounts {
  uint64_t merge = 0, split = 0, genus_up = 0, genus_down = 0, birth = 0, death = 0, rollback = 0;
  uint64_t handles[4] = {0, 0, 0, 0};  // joining 2, 3, 4, more
  // For each group of contacts: the pairs of triangles at the start of its step, divided by the groups of the step.
  std::vector<double> contacts;

  // Adds the events of the last step.
  void add(const tpa_context* context, const tpa_report& report);
};

// The members "events" and "handles" of the reports.
void describe(JsonWriter& json, const EventCounts& events);

}  // namespace tool
