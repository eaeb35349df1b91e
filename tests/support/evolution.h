// SPDX-License-Identifier: MIT
// evolution: a mesh under a row of calls with events, the same calls on any context with the same mesh. Contexts of
// different histories are compared call by call.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/state_support.h"
#include "support/step_scenes.h"

namespace support {

struct Evolution {
  std::string name;
  Mesh mesh;
  int calls;
  tpa_config config;  // with ample limits
  // The targets of one call, for the mesh at its start.
  std::function<Targets(const Mesh&, Random&)> targets;
};

// Scenes with handles, caps and splits; noise; coinciding faces, with vertices left behind; few vertices moved at a
// time.
std::vector<Evolution> Evolutions(uint64_t seed);

// Status, report and digest of a call.
struct Called {
  tpa_status status;
  tpa_issue issue;
  tpa_report report;
  uint64_t digest;
};

// Sets the targets of call `number`; none for tpa_remesh, which drops them even if it fails.
void Prepare(tpa_context* context, const Evolution& e, int number, uint64_t seed);
// Mostly tpa_step, but also tpa_remesh, tpa_smooth and tpa_adapt.
Called Call(tpa_context* context, int number);

// Same status, report and digest.
void ExpectSame(const Called& a, const Called& b, const std::string& what);

}  // namespace support
