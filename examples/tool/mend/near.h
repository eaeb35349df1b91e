// SPDX-License-Identifier: MIT
// near: vertices by cells of a grid, to find those near a place.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace tool {

class NearGrid {
 public:
  // Pre: reach > 0. The positions stay with the caller.
  NearGrid(const std::vector<double>& positions, double reach) : positions_(positions), reach_(reach) {}

  void add(uint32_t v) { cells_.emplace(key_of(cell_of(&positions_[3 * size_t{v}])), v); }

  // Calls visit(v) for each vertex within the reach of p along every axis, and some more; false ends the search.
  template <class Visit>
  void for_each_near(const double* p, Visit visit) const {
    const Cell middle = cell_of(p);
    for (int i = 0; i < 27; ++i) {
      const Cell cell = {middle[0] + i % 3 - 1, middle[1] + i / 3 % 3 - 1, middle[2] + i / 9 - 1};
      const auto [first, last] = cells_.equal_range(key_of(cell));
      for (auto at = first; at != last; ++at)
        if (!visit(at->second)) return;
    }
  }

 private:
  using Cell = std::array<double, 3>;  // whole numbers

  Cell cell_of(const double* p) const {
    return {std::floor(p[0] / reach_), std::floor(p[1] / reach_), std::floor(p[2] / reach_)};
  }
  static uint64_t key_of(const Cell& cell) {
    uint64_t hash = 0;
    for (const double x : cell) {
      hash = (hash ^ std::hash<double>()(x + 0.0)) * 0x9E3779B97F4A7C15u;
      hash ^= hash >> 32;
    }
    return hash;
  }

  const std::vector<double>& positions_;
  double reach_;
  std::unordered_multimap<uint64_t, uint32_t> cells_;
};

}  // namespace tool
