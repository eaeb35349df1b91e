// SPDX-License-Identifier: MIT
// Disjoint sets against labels of all numbers, rewritten with each join.
#include "base/disjoint_sets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace disjoint_sets_test {
namespace {

// A set has the name of its least number; the same pairs in another order give the same names.
TEST(DisjointSets, AreNamedByTheirLeastWhateverTheOrder) {
  for (uint32_t seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    const auto below = [&](uint32_t end) { return static_cast<uint32_t>(random() % end); };
    const uint32_t n = 1 + below(90);
    std::vector<std::pair<uint32_t, uint32_t>> pairs(below(n + n / 2 + 1));
    for (auto& pair : pairs) pair = {below(n), below(n)};
    std::vector<uint32_t> label(n);
    std::iota(label.begin(), label.end(), 0u);
    for (const auto& [a, b] : pairs) {
      const auto [least, most] = std::minmax(label[a], label[b]);
      std::replace(label.begin(), label.end(), uint32_t{most}, uint32_t{least});
    }
    for (int order = 0; order < 3; ++order) {
      std::vector<uint32_t> parent(n);
      std::iota(parent.begin(), parent.end(), 0u);
      for (const auto& [a, b] : pairs) tpa::join_sets(parent.data(), order == 1 ? b : a, order == 1 ? a : b);
      for (uint32_t i = 0; i < n; ++i)
        ASSERT_EQ(tpa::find_set(parent.data(), i), label[i]) << "seed " << seed << ", " << i;
      std::shuffle(pairs.begin(), pairs.end(), random);
    }
  }
}

}  // namespace
}  // namespace disjoint_sets_test
