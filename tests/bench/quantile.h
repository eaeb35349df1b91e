// SPDX-License-Identifier: MIT
// quantile: of some numbers, the one that a share of them is below; 0 of none.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace bench {

inline double Quantile(std::vector<double> x, double q) {
  std::sort(x.begin(), x.end());
  return x.empty() ? 0 : x[std::min(x.size() - 1, static_cast<size_t>(q * static_cast<double>(x.size())))];
}

}  // namespace bench
