// SPDX-License-Identifier: MIT
// region_trial: tpa_adapt on a field mesh, judged from outside: is the result the boundary of the region of winding
// number >= 1 of the given mesh, exactly up to rounding?
#pragma once

#include "support/field_meshes.h"
#include "support/support.h"

namespace support {

enum class Outcome {
  right,
  refused,  // a status and the mesh as it was, or unresolved contacts, all of them counted
  wrong     // without a word
};

struct RegionVerdict {
  Outcome outcome = Outcome::right;
  std::string reason;                             // empty if right
  double volume_error = 0, lost = 0, gained = 0;  // shares of the true volume
  bool topology_judged = false;
};

// The result of a call that claims to have resolved everything.
RegionVerdict JudgeRegion(const FieldFamily& family, const Mesh& given, const Mesh& result, uint64_t seed);

struct RegionTrial {
  RegionVerdict verdict;
  Mesh result;
  tpa_report report{};
  double seconds = 0;  // of tpa_adapt
};

// The call alone, right so far unless it refuses. Limits are generous, and doubled where the call names one.
RegionTrial TryToAdapt(const Mesh& given);
// Likewise, and judges the result.
RegionTrial TryRegion(const FieldFamily& family, const Mesh& given, uint64_t seed);

}  // namespace support
