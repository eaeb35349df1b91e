// SPDX-License-Identifier: MIT
// share: how much of a long row of cases a test plays. All of the row, or a part if the environment has
// TOPOADAPT_QUICK_TESTS, as in the preset of the sanitizers: sanitizers find faults of the code, and a further case
// adds little. Test suites with names in Long, of no use in part, are left out in the preset.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>

namespace support {

inline bool IsQuick() {
  static const bool quick = std::getenv("TOPOADAPT_QUICK_TESTS") != nullptr;
  return quick;
}

// `all` cases at random, or a fifth of them, but at least one.
template <class Count>
Count Share(Count all) {
  return IsQuick() ? std::max<Count>(all / 5, 1) : all;
}

// The least number of sightings demanded among all cases, or among a share of the cases, possibly fewer than a fifth.
template <class Count>
Count Least(Count among_all) {
  return IsQuick() ? among_all / 10 : among_all;
}

// One, or the stride that takes one in `part` of a list.
inline size_t Stride(size_t part = 5) { return IsQuick() ? part : 1; }

}  // namespace support
