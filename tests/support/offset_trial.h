// SPDX-License-Identifier: MIT
// offset_trial: steps of bodies that lie up to 1e12 times their size away from the origin, where positions are
// rounded coarsely. Exact predicates of the tests judge the result (P1): free of crossing triangles, or a failure that
// leaves all as it was. tpa_adapt likewise leaves as many pairs as its report counts (P2).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/step_noise.h"

namespace support {

struct OffsetFamily {
  std::string name;
  double offset;  // in sizes of the scene; below 0: any from 1e7 to 1e12
  bool adapts;
  Mesh (*body)(Random& random);
  // Positions to go to; not called for families that adapt.
  Mesh (*moved)(const Mesh& body, Random& random);
  int steps = 1;              // in a row, until one is at fault
  uint64_t long_seeds = 240;  // of the long test, fewer where a seed takes long
};
inline void PrintTo(const OffsetFamily& family, std::ostream* out) { *out << family.name; }
const std::vector<OffsetFamily>& OffsetFamilies();

struct OffsetTrial {
  Step step;
  bool starts_clean = true;  // else rounding has made contacts in the mesh before the step
  bool meets = false;        // the step found contacts
  std::string fault;         // empty: right
};

OffsetTrial PlayOffset(const OffsetFamily& family, uint64_t seed);
// Takes the step, and judges it alone.
OffsetTrial JudgeOffset(const Mesh& before, const Mesh& moved, const tpa_config& config);

}  // namespace support
