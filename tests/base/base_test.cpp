// SPDX-License-Identifier: MIT
// Hashes of pairs of numbers.
#include "base/base.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace base_test {
namespace {

// The half-edges of a fan with a rim numbered by a stride, as in meshes made row by row. In twice as many bins, as in
// the hash that sews handles, the half-edges crowd no more than at random. A hash of a single product puts 13 and more
// into a bin at some strides.
TEST(Scattered, EdgesOfFansDoNotCrowd) {
  constexpr uint32_t rim = 200, hub = 1 << 20;
  for (uint32_t stride = 1; stride < 3000; ++stride) {
    std::vector<int> bins(6 * rim);
    const auto note = [&](uint32_t a, uint32_t b) { ++bins[uint64_t{tpa::scattered(a, b)} * bins.size() >> 32]; };
    for (uint32_t i = 0; i < rim; ++i) {
      const uint32_t v = 7 + i * stride, next = 7 + (i + 1) % rim * stride;
      note(hub, v), note(v, next), note(next, hub);
    }
    // For 600 random throws into 1200 bins, a bin with more than 8 has a probability of 4e-6.
    ASSERT_LE(*std::max_element(bins.begin(), bins.end()), 8) << "stride " << stride;
  }
}

}  // namespace
}  // namespace base_test
