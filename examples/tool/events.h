// events: what happened to the topology, counted for reports.
#pragma once

#include <cstdint>
#include <vector>

#include "tool/json.h"
#include "topoadapt.h"

namespace tool {

struct EventCounts {
  uint64_t merge = 0, split = 0, genus_up = 0, genus_down = 0, birth = 0, death = 0, rollback = 0;
  uint64_t handles[4] = {0, 0, 0, 0};  // joining 2, 3, 4, more
  // For each contact group: the pairs of triangles that its step began with, for each of the step's groups.
  std::vector<double> contacts;

  // Adds what the last step did.
  void add(const tpa_context* context, const tpa_report& report);
};

// The members "events" and "handles" of the reports.
void describe(JsonWriter& json, const EventCounts& events);

}  // namespace tool
