// share: how much of a long row of cases a test plays. All of it, or a part where the environment has
// TOPOADAPT_QUICK_TESTS, as in the preset of the sanitizers: what these find lies in the code and not in one case more.
// Test suites whose names end in Long, of which no part would do, that preset leaves out.
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

// How often something must have been seen among all cases, or among a share of them, which may well be fewer than a
// fifth.
template <class Count>
Count Least(Count among_all) {
  return IsQuick() ? among_all / 10 : among_all;
}

// One, or the stride that takes one in `part` of a list.
inline size_t Stride(size_t part = 5) { return IsQuick() ? part : 1; }

}  // namespace support
