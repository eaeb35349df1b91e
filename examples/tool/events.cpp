// SPDX-License-Identifier: MIT
#include "tool/events.h"

#include <algorithm>

namespace tool {

void EventCounts::add(const tpa_context* context, const tpa_report& report) {
  contacts.insert(contacts.end(), report.groups, static_cast<double>(report.contacts) / std::max(1u, report.groups));
  region.lost += report.region_lost;
  region.gained += report.region_gained;
  if (report.region_after != 0) region.before = report.region_before, region.after = report.region_after;
  const tpa_event* events = nullptr;
  uint32_t count = 0;
  if (tpa_events(context, &events, &count) != TPA_OK) return;
  for (uint32_t i = 0; i < count; ++i) {
    const uint64_t amount = events[i].amount;
    const double* at = events[i].position;
    if (events[i].type == TPA_EVENT_HANDLE || events[i].type == TPA_EVENT_CAP) places.push_back({at[0], at[1], at[2]});
    switch (events[i].type) {
      case TPA_EVENT_HANDLE: ++handles[std::min<uint64_t>(amount, 5) - 2]; break;
      case TPA_EVENT_ROLLBACK: rollback += amount; break;
      case TPA_EVENT_MERGE: merge += amount - 1; break;
      case TPA_EVENT_SPLIT:  // one event for each piece, in a row
        split += amount - 1;
        i += static_cast<uint32_t>(amount) - 1;
        break;
      case TPA_EVENT_GENUS_UP: genus_up += amount; break;
      case TPA_EVENT_GENUS_DOWN: genus_down += amount; break;
      case TPA_EVENT_DEATH: death += amount; break;
      default: break;
    }
  }
}

void describe(JsonWriter& json, const EventCounts& e) {
  json.key("events").begin_object().member("merge", e.merge).member("split", e.split).member("genus_up", e.genus_up);
  json.member("genus_down", e.genus_down).member("death", e.death);
  json.member("rollback", e.rollback).end_object();
  json.key("handles").begin_object().member("k2", e.handles[0]).member("k3", e.handles[1]);
  json.member("k4", e.handles[2]).member("more", e.handles[3]).end_object();
  json.key("region").begin_object().member("before", e.region.before).member("after", e.region.after);
  json.member("left_out", e.region.left_out)
      .member("lost", e.region.lost)
      .member("gained", e.region.gained)
      .end_object();
}

}  // namespace tool
