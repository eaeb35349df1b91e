// SPDX-License-Identifier: MIT
// report_trial: single steps with contacts, and what their reports tell of the region: coarse bodies, noise, and two
// balls that run into each other.
#pragma once

#include <cstdint>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "oracle/region_report.h"
#include "support/step_noise.h"

namespace support {

struct ReportFamily {
  std::string name;
  std::function<Step(uint64_t seed)> play;
};
inline void PrintTo(const ReportFamily& family, std::ostream* out) { *out << family.name; }
const std::vector<ReportFamily>& ReportFamilies();

struct ReportTrial {
  Step step;
  bool meets = false;  // triangles are in contact where the targets are
  ReportVerdict verdict;
  bool IsJudged() const { return step.status == TPA_OK && meets; }
  bool IsAtFault() const {
    return verdict.volume_less || verdict.volume_twice || verdict.reach_less || verdict.reach_twice;
  }
  std::string Text() const;
};

ReportTrial PlayReport(const ReportFamily& family, uint64_t seed);

}  // namespace support
