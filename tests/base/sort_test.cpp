// SPDX-License-Identifier: MIT
// Sorting and counting against the standard library.
#include "base/sort.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <utility>
#include <vector>

namespace sort_test {
namespace {

// Every length up to 129, with odd and even halves at every level; keys repeat, and some keys are absent.
TEST(Sort, SortsAndCountsElementsBefore) {
  std::mt19937 random(1);
  for (uint32_t n = 0; n < 130; ++n) {
    std::vector<uint32_t> a(n);
    for (uint32_t& x : a) x = static_cast<uint32_t>(2 * (random() % (n + 1)) + 1);
    std::vector<uint32_t> sorted = a;
    std::sort(sorted.begin(), sorted.end());
    tpa::sort_in_place(a.data(), n);
    ASSERT_EQ(a, sorted);
    for (uint32_t key = 0; key <= 2 * n + 4; ++key) {
      const auto before = std::lower_bound(a.begin(), a.end(), key) - a.begin();
      ASSERT_EQ(tpa::count_before(a.data(), n, [&](uint32_t x) { return x < key; }), before) << n << ", " << key;
    }
  }
}

TEST(Sort, AsksOnceForEachPairOfAListInOrder) {
  constexpr uint32_t n = 100;
  for (uint32_t swapped = 0; swapped < n; ++swapped) {
    std::vector<uint32_t> a(n), sorted(n);
    for (uint32_t i = 0; i < n; ++i) a[i] = sorted[i] = i / 2;
    if (swapped > 0) std::swap(a[swapped - 1], a[swapped]);
    const bool in_order = a == sorted;
    uint32_t asked = 0;
    tpa::sort_in_place(a.data(), n, [&](uint32_t x, uint32_t y) {
      ++asked;
      return x < y;
    });
    ASSERT_EQ(a, sorted) << "after a swap at " << swapped;
    if (in_order) {
      ASSERT_EQ(asked, n - 1);
    }
  }
}

}  // namespace
}  // namespace sort_test
